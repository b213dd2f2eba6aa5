#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Meshes and a photograph that nobody here made, for tests: unpacked from Debian packages into a
# folder, never installed, never committed. Usage: fetch_assets.sh FOLDER
set -euo pipefail
folder=${1:?usage: fetch_assets.sh FOLDER}
mkdir -p "$folder/packages"
folder=$(cd "$folder" && pwd)

# unpack PACKAGE FILE…: downloads the package and takes only these files out of it.
unpack() {
  local package=$1 path missing=0 scratch
  shift
  for path in "$@"; do [ -s "$folder/$(basename "$path")" ] || missing=1; done
  [ $missing -eq 1 ] || return 0
  echo "fetching $package"
  scratch=$(mktemp -d "$folder/packages/XXXXXX")
  # apt's own sandbox user cannot write here; as root that is only a warning.
  (cd "$scratch" && apt-get -o Acquire::Retries=3 download "$package" 2>&1)
  dpkg-deb -x "$scratch"/"$package"_*.deb "$scratch/files"
  for path in "$@"; do
    test -s "$scratch/files/$path" || { echo "$package has no $path" >&2; return 1; }
    mv "$scratch/files/$path" "$folder/"
  done
  rm -rf "$scratch"
}

unpack glmark2-data usr/share/glmark2/models/bunny.obj usr/share/glmark2/models/horse.3ds
unpack python3-skimage usr/lib/python3/dist-packages/skimage/data/astronaut.png
unpack sweethome3d-furniture usr/share/sweethome3d/furniture/Scopia.sh3f
for person in mannequinMale mannequinBrunette; do
  [ -s "$folder/scopia/$person/$person.obj" ] ||
    unzip -q -o "$folder/Scopia.sh3f" "scopia/$person/*" -d "$folder"
done
# Heads for `chiaro study transfer`.
unpack sweethome3d-furniture usr/share/sweethome3d/furniture/Reallusion.sh3f
for person in male01 male02 male03 female01 female02 female03 girlStanding; do
  [ -s "$folder/reallusion/$person/$person.obj" ] ||
    unzip -q -o "$folder/Reallusion.sh3f" "reallusion/$person/*" -d "$folder"
done
# ivcat is in inventor-clients, which not every machine has: without it those three stay away.
if command -v ivcat > /dev/null; then
  models=usr/share/inventor/data/models/CyberHeads
  unpack inventor-data $models/josie.iv $models/paul.iv $models/rikk.iv
  for head in josie paul rikk; do
    mkdir -p "$folder/cyber/$head"
    [ -s "$folder/cyber/$head/$head.obj" ] ||
      ivcat "$folder/$head.iv" |
        awk -v out="$folder/cyber/$head/$head" -f "$(dirname "$0")/quad_mesh.awk"
  done
fi
rmdir "$folder/packages"
ls -l "$folder"
