// hello SOURCE.ply TARGET.ply OUT.ply: the shortest sensible use of the library.
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/registration/fit.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 4) return 1;
  const auto source = ceres_ed::LoadCloud(argv[1]);
  const auto target = ceres_ed::LoadCloud(argv[2]);
  if (!source.ok() || !target.ok()) return 2;
  const auto fit = ceres_ed::Fit(source->cloud, target->cloud);
  if (!fit.ok() || !fit->IsUsable()) return 3;
  std::cout << fit->message << ", rms " << fit->matches.rms_plane << "\n";
  const auto saved = ceres_ed::SaveCloud(
      argv[3], source->document, source->vertex_of_point, fit->points, &fit->normals);
  return saved.ok() ? 0 : 2;
}
