// The code of tinygltf, which its header has.
#define TINYGLTF_IMPLEMENTATION
#include <ceres_ed/gltf/tiny_gltf.h>
