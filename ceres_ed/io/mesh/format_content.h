// Recognises formats of meshes and points by the content of a file. Each function takes the first
// bytes of the file and its size.
#ifndef CERES_ED_IO_MESH_FORMAT_CONTENT_H_
#define CERES_ED_IO_MESH_FORMAT_CONTENT_H_

#include <cstddef>
#include <string_view>

namespace ceres_ed {

bool IsPly(std::string_view start, std::size_t size);
bool IsPcd(std::string_view start, std::size_t size);
bool IsVtk(std::string_view start, std::size_t size);
bool IsVtp(std::string_view start, std::size_t size);
bool IsGlb(std::string_view start, std::size_t size);
bool IsOff(std::string_view start, std::size_t size);
// A text that begins with `solid` and has facets, or a file with the size of a binary STL.
bool IsStl(std::string_view start, std::size_t size);
// A text that begins with a keyword of OBJ and has a vertex.
bool IsObj(std::string_view start, std::size_t size);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_FORMAT_CONTENT_H_
