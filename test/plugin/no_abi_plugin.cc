// A shared object, but no plugin.
extern "C" int Answer() { return 42; }
