#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/registration/fit.h>

int main(int argc, char** argv) {  // hello SOURCE.ply TARGET.ply OUT.ply
  if (argc != 4) return 1;
  const auto source = ceres_ed::LoadCloud(argv[1]);
  const auto target = ceres_ed::LoadCloud(argv[2]);
  if (!source.ok() || !target.ok()) return 2;
  const auto fit = ceres_ed::Fit(source->cloud, target->cloud);
  if (!fit.ok() || !fit->IsUsable()) return 3;
  return ceres_ed::SaveCloud(argv[3], *source, fit->points, &fit->normals).ok() ? 0 : 2;
}
