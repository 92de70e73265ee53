// SPDX-License-Identifier: MIT
// The optional libraries.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/bake/bake_ambient_occlusion.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/render_model.h>
#include <Atlas/report/write_report.h>

#include <cstdio>

int main()
{
  Atlas::Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  soup.vertices = {0, 1, 2, 3};
  soup.close_face();
  soup.uv = {{.25, .25}, {.75, .25}, {.75, .75}, {.25, .75}};
  const Atlas::Image normals = Atlas::bake_normals(soup, 64);
  bool is_good = !Atlas::png_bytes(normals).empty() && !Atlas::glb_bytes(soup, "").empty();
  Atlas::write_obj("consumer.obj", soup);
  is_good = is_good && Atlas::read_polygon_soup("consumer.obj").uv == soup.uv;
  is_good = is_good && !Atlas::html_report(soup, {}, {normals, normals, normals}, "square").empty();
#ifdef HAS_ALL_COMPONENTS
  is_good = is_good && Atlas::render_model(soup, Atlas::checkerboard(64)).width == 1280;
  is_good = is_good && Atlas::bake_ambient_occlusion(soup, 64).at(32, 32) == Atlas::Color{255, 255, 255};
#endif
  std::puts(is_good ? "good" : "not good");
  return is_good ? 0 : 1;
}
