// SPDX-License-Identifier: MIT
// The part of the command line that is about pictures and bakes.
#include "bakes.h"
#include <CLI/CLI.hpp>
#include <map>
#include <string>

void add_picture_options(CLI::App& app, Options& options)
{
  app.add_flag("--pictures", options.has_pictures,
               "Also write pictures, with the stem of the output: the page with its charts in colours "
               "(_page.png), its stretch (_stretch.png), the model from several sides (_view.png), and a "
               "report with all of them and the model to turn (.html)");
  app.add_option("--picture", options.picture,
                 "Also write one PNG picture with the page and the model side by side");
  app.add_option(
         "--bake", options.bakes,
         "What to bake into the page: `colors` of the vertices (_color.png) or the old `texture` "
         "(_texture.png) instead of the checkerboard; `normals` in the space of the model "
         "(_normal.png) or in tangent space (_tangent_normal.png, by MikkTSpace; the model gets "
         "normals if it has none) and ambient `occlusion` (_occlusion.png) beside it; with --bake-from "
         "`displacement` (_displacement.png), the height of that mesh along the normals. May be given "
         "several times")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, Bake>{{"colors", Bake::colors},
                                                              {"texture", Bake::texture},
                                                              {"normals", Bake::normals},
                                                              {"tangent-normals", Bake::tangent_normals},
                                                              {"occlusion", Bake::occlusion},
                                                              {"displacement", Bake::displacement}})
              .description("colors|texture|normals|tangent-normals|occlusion|displacement"))
      ->allow_extra_args(false);
  app.add_flag(
         "--seamless", options.is_seamless,
         "Change the texels along seams, as little as it takes, so that both sides of every seam show the "
         "same colour, or normal, at mip levels 0 to 2; the report tells the largest difference that "
         "is left. Goes well with --mip-levels 2")
      ->needs("--bake");
  CLI::Option* bake_from =
      app.add_option(
             "--bake-from", options.detail,
             "Bake from another mesh of the same shape and place, such as the scan that MESH has been "
             "simplified from: what its nearest face along the normal shows, which looks the same "
             "way, or its nearest point where there is none within the cage")
          ->needs("--bake");
  app.add_option("--cage", options.cage,
                 "How far that mesh is looked for along normals, as a share of the diagonal of its bounding "
                 "box; 0 takes nearest points alone")
      ->check(CLI::Range(0.0, 1.0))
      ->needs(bake_from)
      ->capture_default_str();
}
