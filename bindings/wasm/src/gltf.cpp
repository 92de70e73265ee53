// SPDX-License-Identifier: MIT
// The reader of glTF, from its header. There is no decoder of pictures in the browser's build: models are
// read without them.
#define TINYGLTF_IMPLEMENTATION
#include <Atlas/core/errors.h>
#include <Atlas/image/Image.h>

#include <tiny_gltf.h>

namespace Atlas {

Image decode_image(std::string_view, const std::string& name)
{
  throw IO_error(name + ": this build reads no pictures");
}

} // namespace Atlas
