// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/base/one_dataset.h"

#include "engine/io/base/hdf5_file.h"

#include <QTest>

#include <fstream>
#include <sstream>

namespace episcope::test {

void write_row(const std::filesystem::path& path, hsize_t length, const OnObject& store,
               const OnObject& fill) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(1, &length, nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  store(creation);
  const hid_t dataset =
      H5Dcreate2(file, "lf", H5T_STD_U8LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  fill(dataset);
  H5Dclose(dataset);
  H5Pclose(creation);
  H5Sclose(space);
  H5Fclose(file);
}

void fill_row(hid_t dataset, std::size_t count) {
  const std::vector<std::uint8_t> samples(count, 170);
  H5Dwrite(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, samples.data());
}

void replace_bytes(const std::filesystem::path& path, const std::string& bytes,
                   const std::string& by) {
  std::stringstream read;
  read << std::ifstream(path, std::ios::binary).rdbuf();
  std::string all = read.str();
  std::size_t at = all.find(bytes);
  QVERIFY(at != std::string::npos);
  for (; at != std::string::npos; at = all.find(bytes, at + by.size())) {
    all.replace(at, bytes.size(), by);
  }
  std::ofstream(path, std::ios::binary) << all;
}

std::vector<std::uint8_t> read_row(const std::filesystem::path& path, std::size_t start,
                                   std::size_t count) {
  std::vector<std::uint8_t> samples(count);
  io::Hdf5Input(path).read<std::uint8_t>("lf", {{start}, {count}}, samples.data());
  return samples;
}

}  // namespace episcope::test
