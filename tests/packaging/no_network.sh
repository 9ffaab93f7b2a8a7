#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# no_network.sh PROGRAM [RUNTIME BUILD]: nothing in the program can ask for an address, open a connection or listen, and
# no library of its own that is there for networks is linked. RUNTIME, an archive that the program contains and that is
# not ours (CUDA's runtime shares memory between processes over local sockets), may import what it likes: then the
# object files of the parts in the folder BUILD are looked at instead of the program.
set -eu
names='socket|connect|bind|listen|accept4?|send(to|msg)?|recv(from|msg)?|getaddrinfo|gethostby.*|avformat_network_init|_ZN?K?[0-9]*Q(Tcp|Udp|Ssl|Network|LocalS).*'
runtime=${2:-}

# imports: what is asked of other files, a name a line.
imports() {
  if [ -n "$runtime" ]; then
    find "$build/engine" "$build/annotation" "$build/widgets" "$build/app" -name '*.o' -exec nm --undefined-only {} + |
      awk '$1 == "U" { print $2 }'
  else
    readelf --wide --dyn-syms "$program" | awk '$7 == "UND" { print $8 }' | sed 's/@.*//'
  fi
}

program=$1
build=${3:-}
all=$(imports | sort -u)
echo "$all" | grep -q '^malloc$' || { echo "no imports found"; exit 1; }
found=$(echo "$all" | grep -Ex "$names" || true)
[ -z "$found" ] || { echo "the program can use networks: $found"; exit 1; }
linked=$(readelf --wide --dynamic "$program" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' |
  grep -Ei 'network|curl|websocket|ssl|libssh' || true)
[ -z "$linked" ] || { echo "the program links libraries for networks: $linked"; exit 1; }
