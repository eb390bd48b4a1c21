#include "ceres_ed/report/picture/scene_picture.h"

#include <ceres_ed/report/picture/panel.h>
#include <ceres_ed/report/picture/text_drawing.h>
#include <ceres_ed/report/view/number_text.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

struct TitledPanel {
  std::string title;
  PanelContents contents;
  // A picture above the panel, or null.
  const ViewPicture* picture = nullptr;
};

const ScalarField* FindField(const Scene& scene, const std::string& key) {
  for (const ViewSurface& surface : scene.surfaces) {
    if (const ScalarField* const field = surface.Find(key)) return field;
  }
  return nullptr;
}

// Returns the frame of everything that the panels show, with a margin.
ViewFrame FrameOf(const std::vector<TitledPanel>& panels,
                  const ViewCamera& camera,
                  const SceneBall& ball) {
  constexpr double kMargin = 0.04;
  const PanelCamera any(camera, ball, {}, 1, 1);
  Eigen::AlignedBox2d box;
  for (const TitledPanel& panel : panels) {
    box.extend(any.Extent(PointsAt(*panel.contents.surface, panel.contents.at)));
    if (panel.contents.timeline == nullptr) continue;
    std::vector<Eigen::Vector3d> path;
    for (const TimelineFrame& frame : panel.contents.timeline->frames) {
      if (frame.map_from_camera) path.push_back(frame.map_from_camera->translation);
    }
    box.extend(any.Extent(path));
  }
  ViewFrame frame;
  if (box.isEmpty() || !(box.diagonal().norm() > 0.0)) return frame;
  const double margin = kMargin * box.sizes().maxCoeff();
  frame.low = box.min().array() - margin;
  frame.high = box.max().array() + margin;
  return frame;
}

class ScenePainter {
 public:
  ScenePainter(const Scene& scene, const PictureOptions& options)
      : scene_(scene),
        options_(options),
        colors_(ColorsOf(options.theme)),
        key_(options.field.empty() ? scene.first_field : options.field),
        field_(FindField(scene, key_)),
        text_(options.width / 62.0) {}

  ColorImage Draw();

 private:
  std::vector<TitledPanel> ListPanels() const;
  std::vector<TitledPanel> ListMoments() const;
  // Draws a picture and its marks with its upper left corner at (left, top).
  void DrawPhoto(const ViewPicture& photo, int left, int top, int width);
  void DrawHeading(double* y);
  void DrawLegend(double y);
  void DrawNodeLegend(double x, double y);
  // Fills the pixels of a disc that are in a part of the picture.
  void FillDisc(const Eigen::Vector2d& at,
                double radius,
                const Rgb& color,
                const Eigen::AlignedBox2i& inside);
  void Write(const std::string& text, double x, double y, double size, const Rgb& color) {
    DrawText(text, x, y, size, color, &picture_);
  }

  const Scene& scene_;
  const PictureOptions& options_;
  const ThemeColors colors_;
  const std::string key_;
  const ScalarField* const field_;
  // The height of a line of text.
  const double text_;
  ColorImage picture_;
};

// Returns panels of the first, the middle and the last moment of a sequence.
std::vector<TitledPanel> ScenePainter::ListMoments() const {
  const Timeline& timeline = *scene_.timeline;
  std::vector<TitledPanel> panels;
  const int last = static_cast<int>(timeline.moments.size()) - 1;
  for (const int moment : std::set<int>{std::min(1, last), last / 2, last}) {
    TitledPanel panel;
    panel.contents.surface = &scene_.surfaces[scene_.panels[0].surface];
    panel.contents.at = panel.contents.surface->moments->AtOf(moment);
    panel.contents.plain = colors_.surface;
    panel.contents.field = key_;
    panel.contents.timeline = &timeline;
    panel.contents.scene_radius = BallAround(scene_).radius;
    const TimelineFrame& frame = timeline.frames[timeline.moments[moment]];
    panel.title = "Frame " + std::to_string(frame.number);
    if (frame.status != "tracked") panel.title += " (" + frame.status + ")";
    if (!timeline.pictures[moment].image.empty()) panel.picture = &timeline.pictures[moment];
    panels.push_back(std::move(panel));
  }
  return panels;
}

std::vector<TitledPanel> ScenePainter::ListPanels() const {
  if (scene_.timeline && scene_.surfaces[scene_.panels[0].surface].moments) return ListMoments();
  std::vector<TitledPanel> panels;
  for (const ViewPanel& panel : scene_.panels) {
    PanelContents contents;
    contents.surface = &scene_.surfaces[panel.surface];
    contents.at = panel.at < 0.0 ? 1.0 : panel.at;
    contents.plain = panel.surface == 0 ? colors_.surface : colors_.other;
    if (panel.is_colored) contents.field = key_;
    if (panel.with_graph) contents.landmarks = &scene_.landmarks;
    panels.push_back({panel.title, contents});
  }
  for (const ViewPanel& panel : scene_.panels) {
    if (!panel.with_graph || scene_.graph.empty()) continue;
    PanelContents contents;
    contents.surface = &scene_.surfaces[panel.surface];
    contents.plain = options_.theme == Theme::kDark ? Rgb{70, 76, 84} : Rgb{230, 233, 237};
    contents.graph = &scene_.graph;
    panels.push_back({"Graph", contents});
    break;
  }
  return panels;
}

void ScenePainter::DrawHeading(double* y) {
  const double room = options_.width - 2.0 * text_;
  if (!options_.title.empty()) {
    *y += 1.6 * text_;
    Write(FitText(options_.title, 1.35 * text_, room), text_, *y, 1.35 * text_, colors_.text);
  }
  if (!options_.subtitle.empty()) {
    *y += 1.3 * text_;
    Write(FitText(options_.subtitle, text_, room), text_, *y, text_, colors_.soft);
  }
  *y += 0.6 * text_;
}

// Draws the colours between their ends, with what they show.
void ScenePainter::DrawLegend(double y) {
  const FieldRange& range = field_->range;
  const std::string low = ShortNumber(range.low);
  const std::string high = ShortNumber(range.high) + (range.max > range.high ? " and more" : "");
  const std::string name = field_->name + " [" + field_->unit + "], up to " +
                           ShortNumber(range.max) + AsideNote(*field_);
  double x = text_;
  Write(low, x, y + text_, text_, colors_.text);
  x += TextWidth(low, text_) + 0.5 * text_;
  const int width = options_.width / 6;
  for (int u = 0; u < width; ++u) {
    const Rgb color = ColorAt(field_->scale, static_cast<double>(u) / (width - 1));
    for (int v = 0; v < static_cast<int>(text_); ++v) {
      const int at_u = static_cast<int>(x) + u;
      const int at_v = static_cast<int>(y + 0.2 * text_) + v;
      if (picture_.Contains(at_u, at_v)) picture_(at_u, at_v) = color;
    }
  }
  x += width + 0.5 * text_;
  Write(high, x, y + text_, text_, colors_.text);
  x += TextWidth(high, text_) + 1.2 * text_;
  Write(FitText(
            name, text_, options_.width - x - text_ - (scene_.graph.empty() ? 0.0 : 13.0 * text_)),
        x,
        y + text_,
        text_,
        colors_.text);
}

// Returns the height of a picture that is `width` pixels wide.
int PhotoHeight(const ViewPicture& photo, int width) {
  return width * photo.image.height() / photo.image.width();
}

void ScenePainter::DrawPhoto(const ViewPicture& photo, int left, int top, int width) {
  const double scale = static_cast<double>(photo.image.width()) / width;
  const int height = PhotoHeight(photo, width);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (!picture_.Contains(left + u, top + v)) continue;
      // Between the four pixels around.
      const double x = std::clamp(scale * (u + 0.5) - 0.5, 0.0, photo.image.width() - 1.0);
      const double y = std::clamp(scale * (v + 0.5) - 0.5, 0.0, photo.image.height() - 1.0);
      const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
      const int x1 = std::min(x0 + 1, photo.image.width() - 1);
      const int y1 = std::min(y0 + 1, photo.image.height() - 1);
      for (std::size_t c = 0; c < 3; ++c) {
        const double above =
            (x0 + 1 - x) * photo.image(x0, y0)[c] + (x - x0) * photo.image(x1, y0)[c];
        const double below =
            (x0 + 1 - x) * photo.image(x0, y1)[c] + (x - x0) * photo.image(x1, y1)[c];
        picture_(left + u, top + v)[c] =
            static_cast<std::uint8_t>(std::lround((y0 + 1 - y) * above + (y - y0) * below));
      }
    }
  }
  const double radius = 0.16 * text_;
  const Eigen::AlignedBox2i inside(Eigen::Vector2i(left, top),
                                   Eigen::Vector2i(left + width - 1, top + height - 1));
  for (const PictureMark& mark : photo.marks) {
    const Eigen::Vector2d at = mark.pixel / scale + Eigen::Vector2d(left, top);
    FillDisc(at, 1.6 * radius, kMarkRim, inside);
    FillDisc(at, radius, kMarkColor, inside);
  }
}

void ScenePainter::FillDisc(const Eigen::Vector2d& at,
                            double radius,
                            const Rgb& color,
                            const Eigen::AlignedBox2i& inside) {
  for (int v = static_cast<int>(at.y() - radius); v <= at.y() + radius + 1.0; ++v) {
    for (int u = static_cast<int>(at.x() - radius); u <= at.x() + radius + 1.0; ++u) {
      const bool is_inside = (Eigen::Vector2d(u, v) - at).norm() <= radius;
      if (!is_inside || !inside.contains(Eigen::Vector2i(u, v))) continue;
      if (picture_.Contains(u, v)) picture_(u, v) = color;
    }
  }
}

void ScenePainter::DrawNodeLegend(double x, double y) {
  const auto known = [&](NodeKind kind) {
    return std::count(scene_.graph.kinds.begin(), scene_.graph.kinds.end(), kind) > 0;
  };
  for (const auto& [kind, name, color] :
       {std::tuple(NodeKind::kPr, "PR", kPrColor),
        std::tuple(NodeKind::kPi, "PI", kPiColor),
        std::tuple(NodeKind::kInner, "inside", kOtherNodeColor)}) {
    if (!known(kind)) continue;
    const double radius = 0.32 * text_;
    const Eigen::AlignedBox2i everywhere(
        Eigen::Vector2i(0, 0), Eigen::Vector2i(picture_.width() - 1, picture_.height() - 1));
    FillDisc({x + radius, y + 0.35 * text_ + radius}, radius, color, everywhere);
    Write(name, x + 0.9 * text_, y + text_, text_, colors_.text);
    x += 1.6 * text_ + TextWidth(name, text_);
  }
}

ColorImage ScenePainter::Draw() {
  const std::vector<TitledPanel> panels = ListPanels();
  if (panels.empty()) return {};
  constexpr int kColumns = 4;
  const int columns = std::min(kColumns, static_cast<int>(panels.size()));
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  const int width = options_.width / columns;
  const ViewCamera camera = ChooseCamera(scene_);
  const SceneBall ball = BallAround(scene_);
  const ViewFrame frame = FrameOf(panels, camera, ball);
  const Eigen::Vector2d size = frame.high - frame.low;
  const int height =
      std::clamp(static_cast<int>(width * size.y() / size.x()), width / 3, options_.width / 2);
  const double title = 1.5 * text_;
  // Pictures stand above the panels of their moments.
  const int margin = static_cast<int>(0.25 * text_);
  int photo_height = 0;
  for (const TitledPanel& panel : panels) {
    if (panel.picture == nullptr) continue;
    photo_height = std::max(photo_height, PhotoHeight(*panel.picture, width - 2 * margin));
  }
  const double heading = 0.6 * text_ + (options_.title.empty() ? 0.0 : 1.6 * text_) +
                         (options_.subtitle.empty() ? 0.0 : 1.3 * text_);
  const double legend = field_ != nullptr || !scene_.graph.empty() ? 2.0 * text_ : 0.0;
  picture_ = ColorImage(options_.width,
                        static_cast<int>(heading + rows * (height + photo_height + title) + legend),
                        colors_.ground);
  double y = 0.0;
  DrawHeading(&y);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const int left = static_cast<int>(i) % columns * width;
    const int row = static_cast<int>(i) / columns;
    const double top = y + row * (height + photo_height + title);
    if (panels[i].picture != nullptr) {
      DrawPhoto(
          *panels[i].picture, left + margin, static_cast<int>(top + title), width - 2 * margin);
    }
    const ColorImage panel =
        DrawPanel(panels[i].contents, camera, ball, frame, width, height, options_.theme);
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        const int at_v = static_cast<int>(top + title) + photo_height + v;
        if (picture_.Contains(left + u, at_v)) picture_(left + u, at_v) = panel(u, v);
      }
    }
    const std::string words = FitText(panels[i].title, 1.1 * text_, width - text_);
    Write(words,
          left + 0.5 * (width - TextWidth(words, 1.1 * text_)),
          top + 1.1 * text_,
          1.1 * text_,
          colors_.text);
  }
  y += rows * (height + photo_height + title);
  if (field_ != nullptr) DrawLegend(y);
  if (!scene_.graph.empty()) DrawNodeLegend(options_.width - 12.0 * text_, y);
  return std::move(picture_);
}

}  // namespace

ColorImage DrawScene(const Scene& scene, const PictureOptions& options) {
  return ScenePainter(scene, options).Draw();
}

}  // namespace ceres_ed
