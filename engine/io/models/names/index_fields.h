// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// A number in the name of an image.
struct NameNumber {
  std::string text;          ///< As written, without its sign: "07", "369.230769".
  double value = 0;          ///< Without its sign.
  bool is_whole = true;      ///< Has neither a point nor an exponent.
  bool has_minus = false;    ///< A "-" stands before it, and no digit before that,
  bool may_be_dash = false;  ///< but a letter does: "view-3".
  bool has_plus = false;     ///< A "+" stands there.

  /// Value as an index: whole, of at most 18 digits.
  [[nodiscard]] std::optional<long long> count() const;
  [[nodiscard]] std::optional<long long> signed_count() const;
  /// Value as a position, with its sign.
  [[nodiscard]] double position() const { return has_minus && value != 0 ? -value : value; }
};

/// Mark for each number in a skeleton, which no name can hold.
inline constexpr char kNumberMark = '/';

/// Name of an image, without its folder: "out_03_-1.5.png" has the skeleton "out_/_/.png" and the
/// numbers 3 and −1.5. Digits of the suffix are no numbers, and its letters count as lower case.
struct NameParts {
  std::string skeleton;
  std::vector<NameNumber> numbers;
};
[[nodiscard]] NameParts split_name(const std::filesystem::path& path);

struct NumberedImage {
  std::filesystem::path path;
  std::vector<NameNumber> numbers;
};

/// Images whose names differ in numbers only, by name.
struct NameGroup {
  std::string skeleton;
  std::vector<NumberedImage> images;
};

/// Groups images by skeleton, the largest group first. Names without numbers form groups too.
[[nodiscard]] std::vector<NameGroup> group_by_name(
    const std::vector<std::filesystem::path>& images);

/// Order of two numbers according to the words beside them.
enum class WordOrder { Unknown, RowFirst, ColumnFirst };

/// Words of a group's names, in lower case.
class NameWords {
 public:
  explicit NameWords(const std::string& skeleton);

  /// Order according to the words before both numbers, or after both: row and col(umn), r and c, y
  /// and x, v and u, t and s, in either order. The word row or col(umn) alone suffices; a single
  /// letter does not, because it may stand for anything.
  [[nodiscard]] WordOrder order_of(std::size_t first, std::size_t second) const;

  /// Whether a word says that a number counts frames, times or exposures.
  [[nodiscard]] bool is_other_count(std::size_t number) const;

  /// The word before a number; may be empty.
  [[nodiscard]] const std::string& before(std::size_t number) const { return before_[number]; }

  /// Whether only a separator precedes a number.
  [[nodiscard]] bool is_free(std::size_t number) const { return free_[number]; }

 private:
  std::vector<std::string> before_;  ///< The word before each number; may be empty.
  std::vector<std::string> after_;   ///< The word that follows it at once.
  std::vector<bool> free_;
};

/// Whether names hold a word for data beside views: label, mask, depth, disparity, normal,
/// thumbnail, …
[[nodiscard]] bool names_companions(const std::string& skeleton);

/// Whether names hold a word for one image that is a light field: eslf, macpi, qs of a quilt.
[[nodiscard]] bool names_mosaics(const std::string& skeleton);

/// Meaning of the numbers in the names of a group.
struct IndexFields {
  enum class Form {
    Grid,     ///< Row and column of every place of a full grid,
    Gaps,     ///< of a grid with places that are missing,
    List,     ///< or one index.
    Unclear,  ///< Several numbers vary, and none or several pairs of them form a grid.
    None      ///< No number varies, or there are less than two names.
  };
  Form form = Form::None;
  std::optional<std::size_t> row{};
  std::optional<std::size_t> column{};
  std::optional<std::size_t> index{};
  std::optional<std::size_t> y{};  ///< Positions of cameras.
  std::optional<std::size_t> x{};
  bool is_told_by_words = false;  ///< Which number is the row and which the column.
  bool are_signed = false;        ///< Rows and columns are numbered from a negative number on.
};

/// Finds row and column among the numbers of names. Numbers with a fraction or a minus are
/// positions, not indices. An exception: two numbers in equal steps from below 0 to above it that
/// form a full grid, −2 … 2 by −2 … 2, if no other number varies. An index runs in equal steps. Of
/// several pairs that form a full grid, pairs beside words such as row and col come first, then
/// pairs that begin at 0 or 1 without gaps, then neighbors. Numbers that repeat a pair in another
/// form are skipped. One varying number beside a constant 0 or 1 in its form is a single row or
/// column. The first two positions behind row and column are y and x, unless words tell otherwise.
/// Linear in the number of names.
[[nodiscard]] IndexFields find_index_fields(const NameGroup& group);

/// Pattern of the names with these fields: "out_{row}_{col}_{y}_{x}.png". Other varying numbers
/// become "*".
[[nodiscard]] std::string pattern_text(const NameGroup& group, const IndexFields& fields);

/// Separates row and column in names where their digits run together, as in view11.png …
/// view99.png. The only varying number must have an even count of digits everywhere, its halves
/// must run over a full grid from 0 or 1 on, and as one number it must have gaps. Other groups stay
/// as they are.
void separate_joined_digits(NameGroup& group);

}  // namespace episcope::io
