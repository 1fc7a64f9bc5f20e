#!/usr/bin/env bash
# Shadows of the Island of Hawaii in the morning, at noon and in the evening, from nothing: installs missing Debian
# packages, builds the duskline command, and writes masks, shadow heights and pictures into demo-output/.
set -euo pipefail
cd "$(dirname "$0")"

build=build/release
duskline=$build/apps/duskline/duskline
dem=data/hawaii_2048.tif
out=demo-output

tools/install_dependencies.sh build
echo "Building $duskline"
cmake --preset release -DDUSKLINE_BUILD_TESTS=OFF -DDUSKLINE_BUILD_BENCH=OFF -DDUSKLINE_BUILD_EXAMPLES=OFF >/dev/null
cmake --build $build --parallel "$(nproc)"
mkdir -p $out

# usage: make COMMAND OUTPUT TIME [OPTIONS]: runs one command on the terrain and says how long it took.
make() {
    local command=$1 output=$2 time=$3 begin=${EPOCHREALTIME/[.,]/}
    shift 3
    $duskline "$command" $dem "$out/$output" --time "$time" --overwrite --quiet "$@"
    local milliseconds=$(((${EPOCHREALTIME/[.,]/} - begin) / 1000))
    printf '  %-40s %6d ms\n' "$out/$output" "$milliseconds"
}

echo
echo "The Island of Hawaii, 2048 x 2048 cells of 75 m, on 2026-03-20. Time of each whole command, files included:"
for moment in morning=06:50 noon=12:30 evening=18:10; do
    name=${moment%=*} time=2026-03-20T${moment#*=}-10:00
    echo "$name, ${moment#*=}: mask (0 shadow, 1 lit), shadow heights in metres, picture"
    make shadow ${name}_shadow.tif "$time"
    make shadow ${name}_shadow_heights.tif "$time" --heights
    make relief ${name}_relief.png "$time"
done

cat <<END

Look at $out/evening_relief.png first. On your own elevation model:
  $duskline shadow DEM.tif shadow.tif --time 2026-06-21T18:30+02:00
  $duskline relief DEM.tif picture.png --time 2026-06-21T18:30+02:00
  $duskline --help
END
