// PCL's untyped cloud as a document, and back.
#ifndef CERES_ED_PCL_CLOUD_DOCUMENT_H_
#define CERES_ED_PCL_CLOUD_DOCUMENT_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <cstdint>
#include <optional>
#include <string>

#include <pcl/PCLPointCloud2.h>

namespace ceres_ed {

// The type of a document's values for PCL's type of a field, or nothing for integers of 64 bits.
std::optional<PlyType> PlyTypeOf(std::uint8_t type);

// Writes `value`, which fits it, as a number of `type` to `bytes`.
void StoreNumber(PlyType type, double value, std::uint8_t* bytes);

// Returns the points as element 'vertex', a property a field, but `rgb` and `rgba` as red green
// blue and alpha, and a field of several numbers as a list. Padding ('_') is left out. An obj_info
// line `num_cols` and one `num_rows` keep the size of a cloud of several rows. Errors, behind
// `name`: fields that lie outside the data, two of one name, integers of 64 bits.
StatusOr<PlyDocument> DocumentFromPcl(const std::string& name, const pcl::PCLPointCloud2& cloud);

// Sets `cloud` to the vertices of `document`, without padding. nx ny nz are called normal_x
// normal_y normal_z, as PCL does, and red green blue in uchar are packed into `rgb` or, with alpha,
// `rgba`. With `single_precision` double coordinates and normals become float, as in PCL's point
// types. Errors, behind `name`: no vertices, or lists of different lengths in one property.
Status PclFromDocument(const std::string& name,
                       const PlyDocument& document,
                       bool single_precision,
                       pcl::PCLPointCloud2* cloud);

}  // namespace ceres_ed

#endif  // CERES_ED_PCL_CLOUD_DOCUMENT_H_
