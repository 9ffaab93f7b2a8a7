// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/load_views.h"

#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/exif_orientation.h"
#include "engine/io/open/center_preview.h"
#include "engine/io/open/view_memory.h"

#include <algorithm>

namespace episcope::io {
namespace {

/// Programs that save pictures as small as they can store those without colour as grey.
template <class T>
void copy_grey(const Image<T>& image, ImageView<T> view) {
  for (std::size_t i = 0; i < image.size(); ++i) {
    std::fill_n(view.data + i * static_cast<std::size_t>(view.channels), view.channels,
                image.data()[i]);
  }
}

template <class T>
void store(const std::filesystem::path& path, const AnyImage& decoded, const AnyImage& center,
           ImageView<T> view) {
  const auto* image = std::get_if<Image<T>>(&decoded);
  const bool fits = image != nullptr && image->height() == view.height &&
                    image->width() == view.width &&
                    (image->channels() == view.channels || image->channels() == 1);
  if (!fits) {
    throw IoError(path, "this view has " + describe_image(decoded) + ", but the centre view has " +
                            describe_image(center) + "; all views must match");
  }
  if (image->channels() < view.channels) return copy_grey(*image, view);
  std::copy_n(image->data(), image->size(), view.data);
}

}  // namespace

LightField::Samples load_views(const ViewFiles& views, const OnCenterView& on_center,
                               const Progress& progress) {
  progress.check();
  const ViewIndex center = views.grid.center();
  const int center_index = center.v * views.grid.u + center.u;
  const auto decode = [&](const std::filesystem::path& path) {
    return upright(decode_image(path), views.orientation);
  };
  const AnyImage first = decode(views.files[static_cast<std::size_t>(center_index)]);
  return std::visit(
      [&]<class T>(const Image<T>& image) -> LightField::Samples {
        require_view_memory(views.files.front().parent_path(),
                            static_cast<double>(image.size() * sizeof(T)) * views.grid.count());
        if (on_center) on_center(preview_rgb(image.view()));
        ViewStack<T> stack(views.grid, image.height(), image.width(), image.channels());
        std::copy_n(image.data(), image.size(), stack.view(center).data);
        parallel_for(views.grid.count(), progress, [&](int i) {
          if (i == center_index) return;
          const std::filesystem::path& path = views.files[static_cast<std::size_t>(i)];
          store(path, decode(path), first, stack.view(views.grid.view_at(i)));
        });
        return stack;
      },
      first);
}

}  // namespace episcope::io
