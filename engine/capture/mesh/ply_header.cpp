// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/mesh/ply_header.h"

#include "engine/core/error.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace episcope::capture {
namespace {

constexpr int kMostHeaderLines = 10'000;

// Bytes of a type of PLY; 0 = there is no such type.
int size_of(const std::string& type) {
  struct Type {
    const char* name;
    int size;
  };
  static constexpr std::array<Type, 16> kTypes{{{"char", 1},
                                                {"uchar", 1},
                                                {"int8", 1},
                                                {"uint8", 1},
                                                {"short", 2},
                                                {"ushort", 2},
                                                {"int16", 2},
                                                {"uint16", 2},
                                                {"int", 4},
                                                {"uint", 4},
                                                {"int32", 4},
                                                {"uint32", 4},
                                                {"float", 4},
                                                {"float32", 4},
                                                {"double", 8},
                                                {"float64", 8}}};
  for (const Type& each : kTypes) {
    if (type == each.name) return each.size;
  }
  return 0;
}

bool is_known(const std::string& word) {
  static constexpr std::array<const char*, 7> kWords{
      {"ply", "format", "comment", "obj_info", "element", "property", "end_header"}};
  return word.empty() || std::ranges::find(kWords, word) != kWords.end();
}

struct Property {
  int size = 0;        // of a value
  int count_size = 0;  // of the length of a list; 0 = it is no list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
  std::uint64_t fixed_size = 0;  // of one without lists
  bool has_list = false;
};

enum class Format { Unknown, Ascii, LittleEndian, BigEndian };

struct Header {
  Format format = Format::Unknown;
  std::vector<Element> elements;
};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : path_(path), file_(path, std::ios::binary), end_(std::filesystem::file_size(path)) {
    if (!file_) throw IoError(path, "this mesh cannot be opened");
  }

  void check() {
    const Header header = read_header();
    for (const Element& element : header.elements) {
      if (header.format == Format::Ascii) {
        pass_lines(element);
      } else if (!element.has_list) {
        pass(element.count * element.fixed_size);
      } else {
        for (std::uint64_t i = 0; i < element.count; ++i) pass_one(element, header.format);
      }
    }
  }

 private:
  [[nodiscard]] IoError damaged(const std::string& how) const {
    return {path_, "this mesh cannot be read (" + how + "); export it again"};
  }

  Header read_header() {
    Header header;
    std::string line;
    for (int i = 0; i < kMostHeaderLines && std::getline(file_, line); ++i) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (i == 0 && word != "ply") throw damaged("it does not begin with \"ply\"");
      if (word == "format") header.format = read_format(words);
      if (word == "element") add_element(words, header);
      if (word == "property") read_property(words, header);
      if (!is_known(word)) throw damaged("its header has the line \"" + line.substr(0, 40) + "\"");
      if (word != "end_header") continue;
      if (header.format == Format::Unknown) throw damaged("its header tells no format");
      return header;
    }
    throw damaged("its header has no end");
  }

  Format read_format(std::istringstream& words) const {
    std::string name;
    words >> name;
    if (name == "ascii") return Format::Ascii;
    if (name == "binary_little_endian") return Format::LittleEndian;
    if (name == "binary_big_endian") return Format::BigEndian;
    throw damaged("its format is unknown");
  }

  // Of a second list of vertices or faces assimp writes beyond the memory that it took for the
  // first.
  void add_element(std::istringstream& words, Header& header) const {
    Element element = read_element(words);
    const auto is_of_mesh = [&](const Element& other) {
      const auto is_face = [](const std::string& name) {
        return name == "face" || name == "tristrips";
      };
      return (other.name == "vertex" && element.name == "vertex") ||
             (is_face(other.name) && is_face(element.name));
    };
    if (std::ranges::any_of(header.elements, is_of_mesh)) {
      throw damaged("it has more than one list \"" + element.name + "\"");
    }
    header.elements.push_back(std::move(element));
  }

  Element read_element(std::istringstream& words) const {
    Element element;
    std::string& name = element.name;
    std::int64_t count = -1;
    words >> name >> count;
    // Less than one bit an element cannot be: what is announced is not there.
    if (count < 0 || static_cast<std::uint64_t>(count) > 8 * end_) {
      throw damaged("it has no " + std::to_string(count) + " elements \"" + name + "\"");
    }
    element.count = static_cast<std::uint64_t>(count);
    return element;
  }

  void read_property(std::istringstream& words, Header& header) const {
    if (header.elements.empty()) throw damaged("a property belongs to no element");
    Element& element = header.elements.back();
    std::string type, count_type;
    words >> type;
    if (type == "list") {
      words >> count_type >> type;
      element.has_list = true;
    }
    const Property property{size_of(type), count_type.empty() ? 0 : size_of(count_type)};
    if (property.size == 0 || (!count_type.empty() && property.count_size == 0)) {
      throw damaged("a property has the unknown type \"" + type + "\"");
    }
    element.fixed_size += property.size;
    element.properties.push_back(property);
  }

  // One line an element, as all writers do.
  void pass_lines(const Element& element) {
    std::string line;
    for (std::uint64_t i = 0; i < element.count;) {
      if (!std::getline(file_, line)) throw damaged("it ends in the middle");
      std::istringstream words(line);
      std::string word;
      std::size_t count = 0;
      while (words >> word) ++count;
      if (count == 0) continue;
      if (count < element.properties.size()) throw damaged("a line of it is too short");
      ++i;
    }
  }

  void pass(std::uint64_t bytes) {
    const std::streamoff here = file_.tellg();
    if (here < 0 || static_cast<std::uint64_t>(here) + bytes > end_) {
      throw damaged("it ends in the middle");
    }
    file_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
  }

  // An element with a list, at the place of the file.
  void pass_one(const Element& element, Format format) {
    for (const Property& property : element.properties) {
      std::uint64_t count = 1;
      if (property.count_size > 0) count = read_count(property.count_size, format);
      skip(count * property.size);
    }
  }

  std::uint64_t read_count(int size, Format format) {
    std::uint64_t count = 0;
    for (int i = 0; i < size; ++i) {
      const int byte = next();
      count |= static_cast<std::uint64_t>(byte)
               << (8 * (format == Format::BigEndian ? size - 1 - i : i));
    }
    if (count > end_) throw damaged("a list of it has an impossible length");
    return count;
  }

  int next() {
    const int byte = file_.rdbuf()->sbumpc();
    if (byte == std::char_traits<char>::eof()) throw damaged("it ends in the middle");
    return byte;
  }

  // Short ways within the buffer; a seek would empty it.
  void skip(std::uint64_t bytes) {
    if (bytes > 4096) return pass(bytes);
    for (std::uint64_t i = 0; i < bytes; ++i) (void)next();
  }

  const std::filesystem::path& path_;
  std::ifstream file_;
  std::uint64_t end_;
};

}  // namespace

void require_whole_ply(const std::filesystem::path& path) {
  Reader(path).check();
}

}  // namespace episcope::capture
