#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# thumbnailer.sh CLI THUMBNAILER PROJECT: a light field, and the project that has it as ../lf.h5, get a picture of the size that is asked for; what is
# none gets no file and no success.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
PATH="$(dirname "$1"):$PATH"
episcope-cli synthesize fronto -o "$work/lf.h5" --views 3x3 --size 96x64 --quiet >/dev/null
"$2" 48 "$work/lf.h5" "$work/thumbnail"
# PNG: signature, then the header with width and height.
[ "$(head -c 4 "$work/thumbnail" | od -An -tx1 | tr -d ' ')" = 89504e47 ]
sides=$(od -An -tu1 -j 16 -N 8 "$work/thumbnail" | tr -s ' ')
[ "$sides" = " 0 0 0 48 0 0 0 32" ] || { echo "the sides are $sides"; exit 1; }
# A project has that of its light field, wherever the light field is.
mkdir "$work/project"
cp "$3" "$work/project/p.episcope"
"$2" 48 "$work/project/p.episcope" "$work/of_project"
cmp "$work/thumbnail" "$work/of_project" || { echo "a project has another thumbnail"; exit 1; }
echo "no light field" >"$work/broken.h5"
if "$2" 48 "$work/broken.h5" "$work/none" 2>/dev/null; then
  echo "a broken file has a thumbnail"
  exit 1
fi
[ ! -e "$work/none" ]
# What a hostile file may take: a program in the place of ours tells its limits.
mkdir "$work/bin"
cat >"$work/bin/episcope-cli" <<'END'
#!/bin/sh
while [ "$1" != -o ]; do shift; done
for limit in t v f; do ulimit -$limit; done >"$2"
END
chmod +x "$work/bin/episcope-cli"
PATH="$work/bin:$PATH" "$2" 48 "$work/lf.h5" "$work/limits"
[ "$(tr '\n' ' ' <"$work/limits")" = "30 8388608 131072 " ] || { cat "$work/limits"; exit 1; }
