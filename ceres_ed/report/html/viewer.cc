#include "ceres_ed/report/html/viewer.h"

#include <ceres_ed/report/html/base64.h>
#include <ceres_ed/report/html/escape.h>
#include <ceres_ed/report/html/scene_data.h>

#include <cstddef>
#include <set>

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
  return html;
}

bool Moves(const Scene& scene) {
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
  const std::string all = std::to_string(surface.all_points) + " points and " +
                          std::to_string(surface.all_triangles) + " triangles";
  if (!surface.IsDecimated()) return surface.name + ": all " + all + ".";
  return surface.name + ": " + std::to_string(surface.points.size()) + " of the points and " +
         std::to_string(surface.triangles.size()) + " triangles, chosen from " + all +
         " in the cells of a grid.";
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
    page->Html(
        "<div class=\"viewer\" id=\"viewer\" hidden>\n" + Controls(scene) +
        "<div class=\"stage\"><canvas id=\"view\" tabindex=\"0\" role=\"img\" aria-label=\"" +
        description + "\"></canvas><div id=\"titles\" aria-hidden=\"true\"></div></div>\n" +
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
