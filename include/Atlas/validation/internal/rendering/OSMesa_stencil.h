// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_RENDERING_OSMESA_STENCIL_H
#define ATLAS_VALIDATION_INTERNAL_RENDERING_OSMESA_STENCIL_H

#include <Atlas/core/Kernel.h>

#include <GL/gl.h>
#include <GL/osmesa.h>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// A triangle to draw: its corners in texels of the tile, and a number.
struct Stencil_triangle
{
  std::array<Point_2, 3> corners;
  Index id;
};

/// \brief An offscreen OpenGL context (Mesa's OSMesa) with a square stencil buffer that counts how often its
/// texels are drawn. Only to be used in the thread that makes it, while it is current there: see `Use`.
class OSMesa_stencil
{
public:
  /// \throw std::runtime_error  no such context can be made here
  explicit OSMesa_stencil(Index size)
      : size_(size), context_(OSMesaCreateContextExt(OSMESA_RGBA, 0, 8, 0, nullptr), &OSMesaDestroyContext)
  {
    const std::string name =
        "an OSMesa context of " + std::to_string(size) + " x " + std::to_string(size) + " texels";
    if (size > largest_size())
      throw std::runtime_error(name + " exceeds the largest viewport");
    buffer_.resize(std::size_t(size) * size);
    const auto side = static_cast<GLsizei>(size);
    make_current();
    GLint bits = 0;
    glGetIntegerv(GL_STENCIL_BITS, &bits);
    if (bits < 8)
      throw std::runtime_error(name + " has no stencil buffer of 8 bits");
    glViewport(0, 0, side, side);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0, size, 0, size, -1, 1);
    glDisable(GL_DITHER);
    glShadeModel(GL_FLAT);
    glEnable(GL_STENCIL_TEST);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
  }
  OSMesa_stencil(const OSMesa_stencil&) = delete;
  OSMesa_stencil& operator=(const OSMesa_stencil&) = delete;
  ~OSMesa_stencil() { release(); }

  /// \brief Makes a stencil current as long as it lives.
  class Use
  {
  public:
    /// \throw std::runtime_error  the context cannot be made current
    explicit Use(OSMesa_stencil& stencil) { stencil.make_current(); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    ~Use() { release(); }
  };

  /// The stencil of that size that the calling thread keeps: making a context takes longer than to draw most
  /// charts. One of another size takes its place.
  /// \throw std::runtime_error  no such context can be made here
  static OSMesa_stencil& of_this_thread(Index size)
  {
    thread_local std::unique_ptr<OSMesa_stencil> kept;
    if (!kept || kept->size() != size) {
      kept.reset();
      kept = std::make_unique<OSMesa_stencil>(size);
    }
    return *kept;
  }

  /// The side of the largest tile that can be made.
  static Index largest_size()
  {
    GLint side = 0;
    OSMesaGetIntegerv(OSMESA_MAX_WIDTH, &side);
    return static_cast<Index>(std::max(side, 1));
  }

  Index size() const { return size_; }

  void load(std::span<const Stencil_triangle> triangles)
  {
    vertices_.clear();
    colors_.clear();
    for (const Stencil_triangle& t : triangles)
      for (const Point_2& p : t.corners) {
        vertices_.push_back({static_cast<GLfloat>(p.x()), static_cast<GLfloat>(p.y())});
        colors_.push_back({static_cast<GLubyte>(t.id), static_cast<GLubyte>(t.id >> 8),
                           static_cast<GLubyte>(t.id >> 16), static_cast<GLubyte>(t.id >> 24)});
      }
  }

  /// How often each texel is drawn, row by row from the bottom; 255 stands for more.
  std::vector<std::uint8_t> counts()
  {
    std::vector<std::uint8_t> result(buffer_.size());
    draw(GL_ALWAYS, 0);
    glReadPixels(0, 0, static_cast<GLsizei>(size_), static_cast<GLsizei>(size_), GL_STENCIL_INDEX,
                 GL_UNSIGNED_BYTE, result.data());
    return result;
  }

  /// Which triangle is the one that is drawn over each texel after `layer` others.
  std::vector<Index> ids(unsigned layer)
  {
    draw(GL_EQUAL, layer);
    glFinish();
    std::vector<Index> result(buffer_.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = Index(buffer_[i][0]) | Index(buffer_[i][1]) << 8 | Index(buffer_[i][2]) << 16 |
                  Index(buffer_[i][3]) << 24;
    return result;
  }

private:
  static void release() { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  void make_current()
  {
    const auto side = static_cast<GLsizei>(size_);
    if (!context_ || !OSMesaMakeCurrent(context_.get(), buffer_.data(), GL_UNSIGNED_BYTE, side, side))
      throw std::runtime_error("cannot make an OSMesa context of " + std::to_string(size_) + " x " +
                               std::to_string(size_) + " texels current");
  }

  /// Draws all triangles; every fragment counts, those at which the count compares well are seen.
  void draw(GLenum comparison, unsigned reference)
  {
    glClearColor(1, 1, 1, 1);
    glClearStencil(0);
    glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glStencilFunc(comparison, static_cast<GLint>(reference), 0xff);
    glStencilOp(GL_INCR, GL_INCR, GL_INCR);
    glVertexPointer(2, GL_FLOAT, 0, vertices_.data());
    glColorPointer(4, GL_UNSIGNED_BYTE, 0, colors_.data());
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices_.size()));
  }

  Index size_;
  std::vector<std::array<GLubyte, 4>> buffer_;
  std::unique_ptr<std::remove_pointer_t<OSMesaContext>, void (*)(OSMesaContext)> context_;
  std::vector<std::array<GLfloat, 2>> vertices_;
  std::vector<std::array<GLubyte, 4>> colors_;
};

} // namespace Atlas::internal

#endif
