// A shared object that is not a plugin.
extern "C" int Answer() { return 42; }
