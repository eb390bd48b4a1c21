#include "ceres_ed/report/picture/text_drawing.h"

#include <ceres_ed/report/picture/font.h>
#include <ceres_ed/report/view/utf8.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb/stb_truetype.h>

namespace ceres_ed {
namespace {

// The font, read once.
struct Font {
  stbtt_fontinfo info;
  bool is_read = false;
};

const Font& TheFont() {
  static const Font font = [] {
    Font read;
    const auto* const bytes = reinterpret_cast<const unsigned char*>(FontFile().data());
    read.is_read = !FontFile().empty() &&
                   stbtt_InitFont(&read.info, bytes, stbtt_GetFontOffsetForIndex(bytes, 0)) != 0;
    return read;
  }();
  return font;
}

// Returns the codes of the characters that the font has.
std::vector<int> CodesOf(std::string_view text) {
  std::vector<int> codes;
  while (!text.empty()) {
    const Utf8Character character = ReadUtf8(text);
    const int code = static_cast<int>(character.code);
    if (stbtt_FindGlyphIndex(&TheFont().info, code) != 0) codes.push_back(code);
    text.remove_prefix(character.size);
  }
  return codes;
}

// Mixes a colour into a pixel; `share` is in [0, 255].
void Blend(const Rgb& color, int share, Rgb* pixel) {
  for (std::size_t c = 0; c < 3; ++c) {
    (*pixel)[c] =
        static_cast<std::uint8_t>(((*pixel)[c] * (255 - share) + color[c] * share + 127) / 255);
  }
}

void DrawGlyph(int code, double x, double y, double scale, const Rgb& color, ColorImage* picture) {
  const double whole = std::floor(x);
  int width = 0;
  int height = 0;
  int left = 0;
  int top = 0;
  unsigned char* const shares = stbtt_GetCodepointBitmapSubpixel(&TheFont().info,
                                                                 static_cast<float>(scale),
                                                                 static_cast<float>(scale),
                                                                 static_cast<float>(x - whole),
                                                                 0.0F,
                                                                 code,
                                                                 &width,
                                                                 &height,
                                                                 &left,
                                                                 &top);
  if (shares == nullptr) return;
  const int u0 = static_cast<int>(whole) + left;
  const int v0 = static_cast<int>(std::lround(y)) + top;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (!picture->Contains(u0 + u, v0 + v)) continue;
      Blend(color, shares[v * width + u], &(*picture)(u0 + u, v0 + v));
    }
  }
  stbtt_FreeBitmap(shares, nullptr);
}

double Advance(int code, int next, double scale) {
  int advance = 0;
  int bearing = 0;
  stbtt_GetCodepointHMetrics(&TheFont().info, code, &advance, &bearing);
  const int kerning = next != 0 ? stbtt_GetCodepointKernAdvance(&TheFont().info, code, next) : 0;
  return scale * (advance + kerning);
}

double ScaleOf(double size) {
  return stbtt_ScaleForPixelHeight(&TheFont().info, static_cast<float>(size));
}

}  // namespace

double TextWidth(const std::string& text, double size) {
  if (!TheFont().is_read) return 0.0;
  const std::vector<int> codes = CodesOf(text);
  double width = 0.0;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    width += Advance(codes[i], i + 1 < codes.size() ? codes[i + 1] : 0, ScaleOf(size));
  }
  return width;
}

void DrawText(const std::string& text,
              double x,
              double y,
              double size,
              const Rgb& color,
              ColorImage* picture) {
  if (!TheFont().is_read) return;
  const double scale = ScaleOf(size);
  const std::vector<int> codes = CodesOf(text);
  for (std::size_t i = 0; i < codes.size(); ++i) {
    DrawGlyph(codes[i], x, y, scale, color, picture);
    x += Advance(codes[i], i + 1 < codes.size() ? codes[i + 1] : 0, scale);
  }
}

std::string FitText(const std::string& text, double size, double width) {
  if (TextWidth(text, size) <= width) return text;
  std::string fitting;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t next = ReadUtf8(rest).size;
    std::string longer = fitting;
    longer += rest.substr(0, next);
    if (TextWidth(longer + "...", size) > width) break;
    fitting = longer;
    rest.remove_prefix(next);
  }
  return fitting + "...";
}

}  // namespace ceres_ed
