# SPDX-License-Identifier: BSD-3-Clause
# Reads names of sources, one a line; says which type names two files define in one namespace. What
# stands in for parts that a build lacks (…unavailable.cpp) is in no program with them, and left out.
# Expects what clang-format writes: what stands in a namespace is not indented, and only a namespace
# of one line ends without a comment.
/unavailable[.]cpp$/ { next }
{
  file = $0
  depth = unnamed = number = opened = 0
  while ((getline line < file) > 0) {
    ++number
    sub(/\r$/, "", line)
    if (line ~ /^(inline )?namespace ([A-Za-z_][A-Za-z0-9_:]* )?[{]/) {
      if (line ~ /}/) continue
      name = line
      sub(/^(inline )?namespace /, "", name)
      sub(/ ?[{].*/, "", name)
      names[++depth] = name
      opened = number
      if (name == "") ++unnamed
    } else if (depth > 0 && (line ~ /^}  \/\/ namespace/ || (line == "}" && number == opened + 2))) {
      if (names[depth--] == "") --unnamed
    } else if (unnamed == 0 && line ~ /^(enum|struct|class|union) /) {
      sub(/ *\/\/.*/, "", line)
      sub(/^(enum class|enum struct|enum|struct|class|union) /, "", line)
      sub(/^(alignas\([^)]*\)|\[\[[^]]*\]\]) /, "", line)
      if (!match(line, /^[A-Za-z_][A-Za-z0-9_]*/)) continue
      name = substr(line, 1, RLENGTH)
      line = substr(line, RLENGTH + 1)
      # Else it is declared, specialised or used, not defined.
      if (line !~ /^( final)?( :[^:].*| [{].*)?$/) continue
      for (i = depth; i > 0; --i) name = names[i] "::" name
      if (!(name in first)) {
        first[name] = file
      } else if (first[name] != file) {
        print name " is defined in " first[name] " and in " file
        ++twice
      }
    }
  }
  close(file)
}
END {
  print twice + 0 " type names are defined twice"
  exit twice > 0
}
