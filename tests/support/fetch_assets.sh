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
# Portraits for `chiaro study photographs`: from Debian, and from npm where npm is there. People can
# be told by them: they stay in this folder.
mkdir -p "$folder/photographs"
cp -n "$folder/astronaut.png" "$folder/photographs/"
unpack python-matplotlib-data usr/share/matplotlib/mpl-data/sample_data/grace_hopper.jpg
cp -n "$folder/grace_hopper.jpg" "$folder/photographs/"
# portraits PACKAGE@VERSION FOLDER NAME…: takes JPEGs out of an npm package, running none of it.
portraits() {
  local package=$1 inside=$2 name prefix missing=0 scratch
  shift 2
  prefix=${package##*/}
  prefix=${prefix%@*}
  for name in "$@"; do [ -s "$folder/photographs/$prefix-$name.jpg" ] || missing=1; done
  [ $missing -eq 1 ] || return 0
  echo "fetching $package"
  scratch=$(mktemp -d "$folder/packages/XXXXXX")
  (cd "$scratch" && npm pack --silent --ignore-scripts "$package" > /dev/null && tar xzf ./*.tgz)
  for name in "$@"; do
    mv "$scratch/package/$inside/$name.jpg" "$folder/photographs/$prefix-$name.jpg"
  done
  rm -rf "$scratch"
}
if command -v npm > /dev/null; then
  portraits material-kit@2.0.4 assets/img/faces avatar camp card-profile1-square \
    card-profile2-square card-profile4-square card-profile5-square card-profile6-square \
    christian kendall marc
  portraits soft-ui-design-system@1.0.4 assets/img jordan bruce-mars charles ivana kal-visuals \
    marie brooke annie-spratt team-1 team-2 team-3 team-4
fi
rmdir "$folder/packages"
ls -l "$folder"
