// SPDX-License-Identifier: MIT
#ifndef ATLAS_EXAMPLE_SCENE_H
#define ATLAS_EXAMPLE_SCENE_H

#include <Atlas/core/Surface.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/pages.h>
#include <Atlas/image/render_model.h>
#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

/// \brief A texture that serves as a palette: a scale of heat with contour lines below, plain colours above.
class Palette
{
public:
  /// Plain colours: charts have numbers from 0 on, and there are some for other things.
  static constexpr int white = -1, dark = -2, red = -3, grey = -4;

  static Atlas::Image image()
  {
    Atlas::Image image(size, size);
    for (std::size_t y = 0; y < size; ++y)
      for (std::size_t x = 0; x < size; ++x)
        image.at(x, y) =
            y >= size / 2 ? color_on_scale(x) : color(int(x / cell + y / cell * columns) - others);
    return image;
  }

  static Atlas::Point_2 plain(int i)
  {
    const int k = i < 0 ? i + others : others + i % (columns * columns / 2 - others);
    return Atlas::Point_2((k % columns + 0.5) / columns, 1 - (k / columns + 0.5) / columns);
  }

  /// \param t in [0, 1]
  static Atlas::Point_2 on_scale(double t)
  {
    return Atlas::Point_2(0.01 + 0.98 * std::clamp(t, 0., 1.), 0.25);
  }

private:
  static constexpr std::size_t size = 2048;
  static constexpr int columns = 32, others = 4;
  static constexpr std::size_t cell = size / columns;
  static constexpr double contours = 16;

  static Atlas::Color color_on_scale(std::size_t x)
  {
    const double t = (double(x) / size - 0.01) / 0.98, phase = t * contours - std::floor(t * contours);
    Atlas::Color color = Atlas::color_of_stretch(std::pow(Atlas::hottest_stretch, t));
    if (phase < 0.14 && t > 0.5 / contours)
      for (std::uint8_t& c : color)
        c = static_cast<std::uint8_t>(c * 2 / 5);
    return color;
  }

  static Atlas::Color color(int i)
  {
    switch (i) {
    case white:
      return {236, 236, 232};
    case dark:
      return {28, 28, 40};
    case red:
      return {216, 32, 24};
    case grey:
      return {200, 200, 198};
    default:
      break;
    }
    Atlas::Color color;
    for (int k = 0; k < 3; ++k)
      color[k] = static_cast<std::uint8_t>(184 + 62 * std::cos(2 * CGAL_PI * (0.618034 * i + k / 3.)));
    return color;
  }
};

/// \brief Triangles and lines in colours of the palette.
class Scene
{
public:
  /// \param thickness of lines, in the unit of the points
  explicit Scene(double thickness) : radius_(thickness / 2) {}

  /// The places of a surface, to which its triangles refer. To be called first.
  void set_points(const std::vector<Atlas::Point_3>& points) { soup_.points = points; }

  void add_triangle(const std::array<Atlas::Index, 3>& corners, const std::array<Atlas::Point_2, 3>& colors)
  {
    soup_.vertices.insert(soup_.vertices.end(), corners.begin(), corners.end());
    soup_.uv.insert(soup_.uv.end(), colors.begin(), colors.end());
    soup_.close_face();
  }

  /// A line is a rod with three sides that sticks out on either side of the surface.
  void add_line(const Atlas::Point_3& p, const Atlas::Point_3& q, int color)
  {
    add_rod(p, q, radius_, color);
  }

  /// A line of a quarter of the thickness.
  void add_thin_line(const Atlas::Point_3& p, const Atlas::Point_3& q, int color)
  {
    add_rod(p, q, radius_ / 4, color);
  }

  Atlas::Image picture(const Atlas::View_direction& view, std::size_t size) const
  {
    return picture(view, size, Palette::image());
  }

  /// \param texture  with the plain colours of the palette where lines have them
  Atlas::Image picture(const Atlas::View_direction& view, std::size_t size, const Atlas::Image& texture) const
  {
    return render_model(soup_, texture, size, {view});
  }

private:
  static constexpr Atlas::Index sides = 6;

  void add_rod(const Atlas::Point_3& p, const Atlas::Point_3& q, double radius, int color)
  {
    const Atlas::Vector_3 along = q - p;
    if (along.squared_length() == 0)
      return;
    const Atlas::Vector_3 least =
        std::abs(along.x()) < std::abs(along.y()) ? Atlas::Vector_3(1, 0, 0) : Atlas::Vector_3(0, 1, 0);
    Atlas::Vector_3 a = CGAL::cross_product(along, least);
    a = a * (radius / std::sqrt(a.squared_length()));
    Atlas::Vector_3 b = CGAL::cross_product(along, a);
    b = b * (radius / std::sqrt(b.squared_length()));
    const Atlas::Vector_3 end = along * (radius / std::sqrt(along.squared_length())); // ends meet
    const auto first = static_cast<Atlas::Index>(soup_.points.size());
    for (Atlas::Index i = 0; i < sides; ++i) {
      const double angle = 2 * CGAL_PI * i / sides;
      const Atlas::Vector_3 off = std::cos(angle) * a + std::sin(angle) * b;
      soup_.points.push_back(p - end + off);
      soup_.points.push_back(q + end + off);
    }
    const Atlas::Point_2 c = Palette::plain(color);
    for (Atlas::Index i = 0; i < sides; ++i) {
      const Atlas::Index here = first + 2 * i, next = first + 2 * ((i + 1) % sides);
      add_triangle({here, next, next + 1}, {c, c, c});
      add_triangle({here, next + 1, here + 1}, {c, c, c});
    }
  }

  double radius_;
  Atlas::Polygon_soup soup_;
};

#endif
