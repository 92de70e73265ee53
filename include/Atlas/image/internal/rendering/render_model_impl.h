// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_RENDERING_RENDER_MODEL_IMPL_H
#define ATLAS_IMAGE_INTERNAL_RENDERING_RENDER_MODEL_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/image/render_model.h>
#include <Atlas/soup/internal/Triangle_list.h>

#include <GL/gl.h>
#include <GL/osmesa.h>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

namespace Atlas {

namespace internal {

/// \brief An OpenGL context of Mesa's offscreen renderer, with a square picture.
class Offscreen_context
{
public:
  explicit Offscreen_context(std::size_t size)
      : size_(size), buffer_(4 * size * size),
        context_(OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr), &OSMesaDestroyContext)
  {
    const auto side = static_cast<GLsizei>(size);
    if (!context_ || !OSMesaMakeCurrent(context_.get(), buffer_.data(), GL_UNSIGNED_BYTE, side, side))
      throw IO_error("cannot create an OSMesa context of " + std::to_string(size) + " x " +
                     std::to_string(size) + " pixels");
  }

  Image picture() const
  {
    glFinish();
    Image image(size_, size_);
    for (std::size_t y = 0; y < size_; ++y)
      for (std::size_t x = 0; x < size_; ++x) {
        const std::uint8_t* const p = &buffer_[4 * ((size_ - 1 - y) * size_ + x)];
        image.at(x, y) = {p[0], p[1], p[2]};
      }
    return image;
  }

private:
  std::size_t size_;
  std::vector<std::uint8_t> buffer_;
  std::unique_ptr<std::remove_pointer_t<OSMesaContext>, void (*)(OSMesaContext)> context_;
};

/// Loads a texture with all its smaller versions; its first row is the top one (v = 1).
inline void load_texture(Image image)
{
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (std::size_t y = 0; y < image.height / 2; ++y)
    for (std::size_t x = 0; x < image.width; ++x)
      std::swap(image.at(x, y), image.at(x, image.height - 1 - y));
  for (GLint level = 0;; ++level) { // down to a single pixel
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGB, static_cast<GLsizei>(image.width),
                 static_cast<GLsizei>(image.height), 0, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
    if (image.pixels.size() <= 1)
      break;
    image = halved(image);
  }
  glEnable(GL_TEXTURE_2D);
}

inline void set_light()
{
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_LIGHTING);
  glEnable(GL_LIGHT0);
  glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE);
  const float ambient[] = {0.42f, 0.42f, 0.42f, 1}, diffuse[] = {0.68f, 0.68f, 0.68f, 1},
              white[] = {1, 1, 1, 1};
  const float direction[] = {-0.35f, 0.55f, 0.9f, 0};
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glLightfv(GL_LIGHT0, GL_POSITION, direction);
  glLightfv(GL_LIGHT0, GL_DIFFUSE, diffuse);
  glLightModelfv(GL_LIGHT_MODEL_AMBIENT, ambient);
  glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, white);
}

inline void draw_view(const Triangle_list& triangles, const View_direction& view)
{
  glClearColor(0.985f, 0.985f, 0.98f, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glOrtho(-1.03, 1.03, -1.03, 1.03, -2, 2);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glRotated(view.elevation, 1, 0, 0);
  glRotated(-view.azimuth, 0, 1, 0);
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_NORMAL_ARRAY);
  glEnableClientState(GL_TEXTURE_COORD_ARRAY);
  glVertexPointer(3, GL_FLOAT, 0, triangles.positions.data());
  glNormalPointer(GL_FLOAT, 0, triangles.normals.data());
  glTexCoordPointer(2, GL_FLOAT, 0, triangles.uv.data());
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(triangles.positions.size() / 3));
}

} // namespace internal

ATLAS_INLINE Image render_model(const Polygon_soup& soup, const Image& texture, std::size_t size,
                                const std::vector<View_direction>& views)
{
  const internal::Triangle_list triangles(soup);
  const internal::Offscreen_context context(2 * size);
  internal::load_texture(texture);
  internal::set_light();
  const std::size_t columns = std::min<std::size_t>(2, views.size()), rows = (views.size() + 1) / 2;
  Image result(columns * size, rows * size);
  for (std::size_t i = 0; i < views.size(); ++i) {
    internal::draw_view(triangles, views[i]);
    paste(halved(context.picture()), result, i % 2 * size, i / 2 * size);
  }
  return result;
}

} // namespace Atlas

#endif
