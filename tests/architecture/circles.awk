# SPDX-License-Identifier: BSD-3-Clause
# Reads names of sources, one a line; says which units (header and source) of one target include each
# other in a circle. -v targets="folder …": the folders of the targets. -v allowed="unit>unit …": includes
# that do not count.
function unit_of(path) {
  sub(/[.][a-z]+$/, "", path)
  return path
}
function target_of(path, i) {
  for (i = 1; i <= folder_count; ++i) {
    if (index(path, folders[i] "/") == 1) return folders[i]
  }
  return ""
}
# Whether includes lead from one unit to another.
function leads(start, goal, queue, first, last, seen, i) {
  queue[1] = start
  seen[start]
  last = 1
  for (first = 1; first <= last; ++first) {
    for (i = 1; i <= fan[queue[first]]; ++i) {
      if (includes[queue[first], i] == goal) return 1
      if (includes[queue[first], i] in seen) continue
      queue[++last] = includes[queue[first], i]
      seen[queue[last]]
    }
  }
  return 0
}
BEGIN {
  folder_count = split(targets, folders, " ")
  count = split(allowed, list, " ")
  for (i = 1; i <= count; ++i) known[list[i]]
}
{
  file = $0
  target = target_of(file)
  unit = unit_of(file)
  while (target != "" && (getline line < file) > 0) {
    if (line !~ /^#include "/) continue
    split(line, parts, "\"")
    other = unit_of(parts[2])
    if (other == unit || target_of(other) != target || (unit ">" other) in known) continue
    if (!((unit, other) in edges)) {
      edges[unit, other]
      includes[unit, ++fan[unit]] = other
      from[++edge_count] = unit
      to[edge_count] = other
    }
  }
  close(file)
}
END {
  for (i = 1; i <= edge_count; ++i) {
    if (!leads(to[i], from[i])) continue
    print from[i] " includes " to[i]
    ++circular
  }
  print circular + 0 " includes are part of a circle"
  exit circular > 0
}
