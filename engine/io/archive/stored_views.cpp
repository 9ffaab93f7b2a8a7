// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive/stored_views.h"

#include "engine/core/parallel/parallel.h"
#include "engine/io/durable/file_descriptor.h"

#include <fcntl.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>

namespace episcope::io {

template <class T>
bool read_stored_views(const Hdf5Input& file, const std::string& name, ViewStack<T>& views,
                       const Progress& progress) {
  const Hdf5Shape shape = file.dataset(name).shape;
  const std::size_t size =
      std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
  const auto begin = file.place_in_file<T>(name);
  if (!begin || size != views.size()) return false;
  const FileDescriptor descriptor(file.path(), O_RDONLY | O_CLOEXEC);
  if (!descriptor.ok()) return false;
  const std::size_t bytes = views.view_size() * sizeof(T);
  std::atomic<bool> is_read = true;
  parallel_for(views.grid().count(), progress, [&](int i) {
    auto* const out = reinterpret_cast<std::uint8_t*>(views.view(views.view_at(i)).data);
    const std::uintmax_t place = *begin + static_cast<std::uintmax_t>(i) * bytes;
    if (is_read && !read_all_at(descriptor.id(), std::span(out, bytes), place)) is_read = false;
  });
  return is_read;
}

template bool read_stored_views(const Hdf5Input&, const std::string&, ViewStack<std::uint8_t>&,
                                const Progress&);
template bool read_stored_views(const Hdf5Input&, const std::string&, ViewStack<std::int32_t>&,
                                const Progress&);
template bool read_stored_views(const Hdf5Input&, const std::string&, ViewStack<std::uint16_t>&,
                                const Progress&);
template bool read_stored_views(const Hdf5Input&, const std::string&, ViewStack<float>&,
                                const Progress&);

}  // namespace episcope::io
