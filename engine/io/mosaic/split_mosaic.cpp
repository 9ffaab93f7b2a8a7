// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/split_mosaic.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>

namespace episcope::io {
namespace {

/// Every `step`-th pixel of a row.
template <class T>
void gather(const T* from, int channels, int step, int count, T* to) {
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(step) * channels;
  for (int x = 0; x < count; ++x, from += stride, to += channels) {
    for (int c = 0; c < channels; ++c) to[c] = from[c];
  }
}

template <class T>
void scatter(const T* from, int channels, int step, int count, T* to) {
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(step) * channels;
  for (int x = 0; x < count; ++x, from += channels, to += stride) {
    for (int c = 0; c < channels; ++c) to[c] = from[c];
  }
}

/// Row `y` of view `view`.
template <class T>
void copy_row(const Image<T>& picture, const MosaicLayout& layout, ViewIndex view, int y, T* to) {
  const int channels = picture.channels();
  if (layout.kind == Mosaic::Lenslets) {
    const T* row = picture.row(y * layout.grid.v + view.v);
    gather(row + view.u * channels, channels, layout.grid.u, layout.width, to);
  } else {
    const T* row = picture.row(view.v * layout.height + y);
    std::copy_n(row + static_cast<std::ptrdiff_t>(view.u) * layout.width * channels,
                layout.width * channels, to);
  }
}

}  // namespace

AnyImage mosaic_view(const AnyImage& picture, const MosaicLayout& layout, ViewIndex view) {
  return std::visit(
      [&]<class T>(const Image<T>& image) -> AnyImage {
        Image<T> one(layout.height, layout.width, image.channels());
        for (int y = 0; y < layout.height; ++y) copy_row(image, layout, view, y, one.row(y));
        return one;
      },
      picture);
}

LightField::Samples split_mosaic(const AnyImage& picture, const MosaicLayout& layout,
                                 const Progress& progress) {
  return std::visit(
      [&]<class T>(const Image<T>& image) -> LightField::Samples {
        ViewStack<T> views(layout.grid, layout.height, layout.width, image.channels());
        // A row of all views at a time: of lenslets, these rows lie side by side in the picture.
        parallel_for(layout.height, progress, [&](int y) {
          for (int i = 0; i < layout.grid.count(); ++i) {
            const ViewIndex view = layout.grid.view_at(i);
            copy_row(image, layout, view, y, views.view(view).row(y));
          }
        });
        return views;
      },
      picture);
}

template <class T>
Image<T> join_lenslets(const ViewStack<T>& views, const Progress& progress) {
  const GridShape grid = views.grid();
  const int channels = views.channels();
  Image<T> picture(views.height() * grid.v, views.width() * grid.u, channels);
  parallel_for(views.height(), progress, [&](int y) {
    for (int i = 0; i < grid.count(); ++i) {
      const ViewIndex view = grid.view_at(i);
      scatter(views.view(view).row(y), channels, grid.u, views.width(),
              picture.row(y * grid.v + view.v) + view.u * channels);
    }
  });
  return picture;
}

template Image<std::uint8_t> join_lenslets(const ViewStack<std::uint8_t>&, const Progress&);
template Image<std::uint16_t> join_lenslets(const ViewStack<std::uint16_t>&, const Progress&);

}  // namespace episcope::io
