// tinygltf without pictures and without reading other files.
#ifndef CERES_ED_GLTF_TINY_GLTF_H_
#define CERES_ED_GLTF_TINY_GLTF_H_

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_JSON
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#endif  // CERES_ED_GLTF_TINY_GLTF_H_
