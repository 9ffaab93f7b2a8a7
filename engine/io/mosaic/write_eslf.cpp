// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/write_eslf.h"

#include "engine/core/error.h"
#include "engine/io/grid/image_file.h"
#include "engine/io/mosaic/split_mosaic.h"

namespace episcope::io {

void write_eslf(const std::filesystem::path& path, const Scene& scene, const Progress& progress) {
  progress.check();
  progress.step("writing " + path.filename().string());
  std::visit(
      [&]<class T>(const ViewStack<T>& views) {
        if constexpr (std::is_same_v<T, float>) {
          throw IoError(
              path,
              "a picture of lenslets holds 8 or 16 bit, but these views are float; choose "
              "a form that holds float samples, for example .npy");
        } else {
          const Image<T> picture = join_lenslets(views, progress.part(0, 0.3));
          progress.check();
          write_png(path, picture.view());
        }
      },
      scene.light_field->samples());
  progress.report(1);
}

}  // namespace episcope::io
