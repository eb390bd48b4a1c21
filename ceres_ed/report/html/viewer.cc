#include "ceres_ed/report/html/viewer.h"

#include <ceres_ed/report/html/base64.h>
#include <ceres_ed/report/html/escape.h>
#include <ceres_ed/report/html/scene_data.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

namespace ceres_ed {
namespace {

// Returns the fields of all surfaces, each once, as the choices of a list.
std::string FieldChoices(const Scene& scene) {
  std::string html = "<option value=\"\">nothing</option>\n";
  std::set<std::string> known;
  for (const ViewSurface& surface : scene.surfaces) {
    for (const ScalarField& field : surface.fields) {
      if (!known.insert(field.key).second) continue;
      html += "<option value=\"" + EscapeHtml(field.key) + "\">" +
              EscapeHtml(field.name + " [" + field.unit + "]") + "</option>\n";
    }
  }
  for (const ViewSurface& surface : scene.surfaces) {
    if (surface.colors.empty()) continue;
    html += std::string("<option value=\"") + kOwnColors + "\">colours of the pictures</option>\n";
    break;
  }
  return html;
}

bool Moves(const Scene& scene) {
  if (scene.timeline) return false;
  for (const ViewPanel& panel : scene.panels) {
    if (panel.at < 0.0) return true;
  }
  return false;
}

bool HasFaces(const Scene& scene) {
  for (const ViewSurface& surface : scene.surfaces) {
    if (!surface.triangles.empty()) return true;
  }
  return false;
}

// Returns the slider over the frames of a sequence.
std::string FrameControls(const Timeline& timeline) {
  const std::string last = std::to_string(timeline.moments.size() - 1);
  return "<div class=\"controls\">\n<label class=\"slider\">Frame <input type=\"range\" "
         "id=\"frame\" min=\"0\" max=\"" +
         last + "\" step=\"1\" value=\"" + last +
         "\"></label>\n<button type=\"button\" id=\"play\">Play</button>\n"
         "<label><input type=\"checkbox\" id=\"path\" checked> camera and tracks</label>\n"
         "<label><input type=\"checkbox\" id=\"marks\" checked> points in the picture</label>\n"
         "<output class=\"frame-text\" id=\"frameText\" aria-live=\"polite\"></output></div>\n";
}

bool HasPicture(const Scene& scene) {
  if (!scene.timeline) return false;
  const std::vector<ViewPicture>& pictures = scene.timeline->pictures;
  return std::any_of(pictures.begin(), pictures.end(), [](const ViewPicture& picture) {
    return !picture.image.empty();
  });
}

// Returns the place where a scene is drawn, with the picture of the frame beside it.
std::string Stage(const Scene& scene, const std::string& description) {
  std::string html =
      "<div class=\"stage\"><canvas id=\"view\" tabindex=\"0\" role=\"img\" aria-label=\"" +
      description + "\"></canvas><div id=\"titles\" aria-hidden=\"true\"></div></div>\n";
  if (!scene.timeline) return html;
  if (!HasPicture(scene)) return "<div class=\"pair alone\">\n" + html + "</div>\n";
  return "<div class=\"pair\">\n" + html +
         "<figure id=\"photoFigure\"><canvas id=\"photo\" role=\"img\" width=\"640\" "
         "height=\"480\" aria-label=\"Colour picture of the frame\"></canvas><figcaption>The "
         "picture of the frame. Circles: " +
         EscapeHtml(scene.timeline->marks) +
         "; lines lead from where they were in the picture before.</figcaption></figure>\n</div>\n";
}

// Returns how much of a sequence is shown.
std::string MomentSentence(const Timeline& timeline) {
  std::string text = " The slider has " + std::to_string(timeline.moments.size()) + " of the " +
                     std::to_string(timeline.frames.size()) + " frames.";
  int width = 0;
  for (const ViewPicture& picture : timeline.pictures) {
    width = std::max(width, picture.image.width());
  }
  if (width > 0) {
    text += " Pictures are " + std::to_string(width) + " pixels across (JPEG), of " +
            std::to_string(timeline.camera.width) + ".";
  }
  return text;
}

std::string Controls(const Scene& scene) {
  std::string html = "<div class=\"controls\">\n<label>Colour by <select id=\"field\">\n" +
                     FieldChoices(scene) + "</select></label>\n";
  if (scene.panels.size() > 1) {
    html +=
        "<label>Layout <select id=\"layout\"><option value=\"beside\">side by side</option>"
        "<option value=\"over\">over each other</option></select></label>\n";
  }
  if (!scene.graph.empty()) {
    html += "<label><input type=\"checkbox\" id=\"graph\"> graph</label>\n";
  }
  if (!scene.landmarks.empty()) {
    html += "<label><input type=\"checkbox\" id=\"landmarks\" checked> landmarks</label>\n";
  }
  if (HasFaces(scene)) {
    html += "<label><input type=\"checkbox\" id=\"edges\"> edges of faces</label>\n";
  }
  html += "<button type=\"button\" id=\"reset\">Reset the view</button>\n";
  if (Moves(scene)) {
    html +=
        "<label class=\"slider\">From source to result <input type=\"range\" id=\"way\" min=\"0\" "
        "max=\"1000\" value=\"1000\"> <output id=\"wayText\"></output></label>\n"
        "<button type=\"button\" id=\"play\">Play</button>\n";
  }
  return html + "</div>\n";
}

// A legend with the ends of the colours, which can be changed; and the figures of one point.
constexpr char kLegend[] =
    "<div class=\"legend\" id=\"legend\" hidden><span id=\"legendName\"></span>\n"
    "<label class=\"end\">from <input type=\"number\" step=\"any\" id=\"low\"></label>\n"
    "<canvas id=\"bar\" width=\"256\" height=\"1\" role=\"img\" aria-label=\"Colours from the low "
    "end "
    "to the high end\"></canvas>\n"
    "<label class=\"end\">to <input type=\"number\" step=\"any\" id=\"high\"></label>\n"
    "<span id=\"legendRange\"></span></div>\n"
    "<div class=\"pick\"><label>Vertex <input type=\"number\" id=\"row\" min=\"0\" "
    "step=\"1\"></label> "
    "of <select id=\"pickSurface\" aria-label=\"Surface of the vertex\"></select>\n"
    "<output id=\"values\" aria-live=\"polite\">Click a surface, or give the number of a vertex, "
    "to "
    "read its figures.</output></div>\n";

std::string Describe(const Scene& scene) {
  std::string text = "3-D view with";
  for (std::size_t i = 0; i < scene.panels.size(); ++i) {
    text += (i > 0 ? ", " : " ") + scene.panels[i].title;
  }
  return text + ". The arrow keys turn it, plus and minus zoom, and Home resets it.";
}

std::string CountSentence(const ViewSurface& surface) {
  const std::string all =
      std::to_string(surface.all_points) + " points" +
      (surface.all_triangles > 0 ? " and " + std::to_string(surface.all_triangles) + " triangles"
                                 : "");
  if (!surface.IsDecimated()) return surface.name + ": all " + all + ".";
  const std::string triangles =
      surface.all_triangles > 0 ? " and " + std::to_string(surface.triangles.size()) + " triangles"
                                : "";
  return surface.name + ": " + std::to_string(surface.points.size()) + " of the points" +
         triangles + ", chosen from " + all + " in the cells of a grid.";
}

}  // namespace

void AddViewer(const Scene& scene, const std::string& picture_png, HtmlPage* page, bool has_three) {
  if (scene.panels.empty()) {
    page->Paragraph("There is nothing to show.");
    for (const std::string& note : scene.notes) page->Notice("note", "Note.", note);
    return;
  }
  std::string picture;
  if (!picture_png.empty()) {
    picture = "<img alt=\"" + EscapeHtml("Picture of the surfaces") +
              "\" src=\"data:image/png;base64," + Base64(picture_png) + "\">\n";
  }
  const std::string description = EscapeHtml(Describe(scene));
  if (!has_three) {
    page->Notice(
        "note",
        "No 3-D view.",
        "ceres_ed was built without three.js (Debian's libjs-three), so there is a picture "
        "in place of the view.");
    page->Html(picture);
  } else {
    page->Html("<div class=\"viewer\" id=\"viewer\" hidden>\n" + Controls(scene) +
               (scene.timeline ? FrameControls(*scene.timeline) : "") + Stage(scene, description) +
               kLegend +
               "<p class=\"hint\">Drag turns, the right button or two fingers move, the wheel or a "
               "pinch zooms after a click into the view. Keys: arrows turn, + and - zoom, Home "
               "resets.</p>\n</div>\n");
    page->Html(
        "<div id=\"still\">" + picture +
        "<p class=\"hint\" id=\"stillText\">The 3-D view needs scripts and WebGL.</p></div>\n");
    page->Data("scene", SceneData(scene));
  }
  std::string counts = "Shown:";
  for (const ViewSurface& surface : scene.surfaces) counts += " " + CountSentence(surface);
  if (scene.timeline) counts += MomentSentence(*scene.timeline);
  if (!scene.graph.empty()) {
    counts += " Nodes of the graph: blue are PR, orange are PI, grey are inside the body.";
  }
  counts +=
      " Positions and figures in the view are rounded to 16 bits (1/65535 of their range); all "
      "tables and plots are of all points.";
  page->Html("<p class=\"hint\">" + EscapeHtml(counts) + "</p>\n");
  for (const std::string& note : scene.notes) page->Notice("note", "Note.", note);
}

}  // namespace ceres_ed
