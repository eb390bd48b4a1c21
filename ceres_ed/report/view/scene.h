// What a page or a picture shows of a run, whatever it is written to.
#ifndef CERES_ED_REPORT_VIEW_SCENE_H_
#define CERES_ED_REPORT_VIEW_SCENE_H_

#include <ceres_ed/report/view/timeline.h>
#include <ceres_ed/report/view/view_camera.h>
#include <ceres_ed/report/view/view_surface.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// What a node is for the data.
enum class NodeKind : unsigned char {
  // Point irrelevant: no data reach it.
  kPi = 0,
  // Point relevant.
  kPr = 1,
  // Inside the body.
  kInner = 2,
  // Either PR or PI; it was not written down.
  kUnknown = 3,
};

// The graph of a moving surface; its nodes are those of the surface's motion.
struct ViewGraph {
  std::vector<std::pair<int, int>> edges;
  std::vector<NodeKind> kinds;

  bool empty() const { return kinds.empty(); }
};

struct ViewLandmark {
  std::string name;
  // The point of the surface that carries it, as an index.
  int point = -1;
  // Where it belongs, in the frame of the scene, and how far the result is from there.
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero();
  double error = 0.0;
};

// The choice of colours that shows the own colours of points.
inline constexpr char kOwnColors[] = "colors";

// A panel shows one surface. All panels of a scene have one camera.
struct ViewPanel {
  std::string title;
  // The index of the surface.
  int surface = 0;
  // Where on its way a moving surface is, in [0, 1]; below 0 it is where the slider says.
  double at = 1.0;
  // Whether this panel shows the graph and the landmarks of the surface, and whether its surface
  // has the colours of the field.
  bool with_graph = false;
  bool is_colored = true;
};

// Several surfaces in one frame.
struct Scene {
  std::vector<ViewSurface> surfaces;
  // The graph and the landmarks of surface 0.
  ViewGraph graph;
  std::vector<ViewLandmark> landmarks;
  std::vector<ViewPanel> panels;
  // The key of the field that is shown first; empty for plain colours, and kOwnColors for the own
  // colours of points.
  std::string first_field;
  // The frames of a sequence; nothing for other scenes.
  std::optional<Timeline> timeline;
  // From where the scene is looked at first; nothing if ChooseCamera() may choose.
  std::optional<ViewCamera> camera;
  // What the scene does not show, and why, in sentences.
  std::vector<std::string> notes;
};

// Returns the place of all points of a surface at `at` on its way.
std::vector<Eigen::Vector3d> PointsAt(const ViewSurface& surface, double at);

// Returns the share of a surface's way that is its rigid placement (WarpMotion::PlacementShare).
double PlacementShareOf(const ViewSurface& surface);

// A ball around all that the panels show, at both ends of every way. Its radius is 1 if there is
// nothing, or only one place.
struct SceneBall {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1.0;
};

SceneBall BallAround(const Scene& scene);

// Sets the ranges of all fields, which are the same for fields of several surfaces with one key.
void SetRanges(Scene* scene);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_SCENE_H_
