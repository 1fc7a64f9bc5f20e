#!/usr/bin/env bash
# Draws the pictures of docs/gallery, and those of docs/algorithms, anew.
#
# usage: tools/render_gallery.sh [DUSKLINE [TERRAINS]]
#   DUSKLINE  the program; build/release/apps/duskline/duskline when left out
#   TERRAINS  folder with the elevation models that the project does not carry (docs/gallery/README.md says
#             where they come from); ../shared/data when left out. Pictures of those that are not there stay
#             as they are.
#
# Needs gdal-bin for projecting and shrinking.
set -euo pipefail
cd "$(dirname "$0")/.."

duskline=${1:-build/release/apps/duskline/duskline}
terrains=${2:-../shared/data}
gallery=docs/gallery
hawaii=data/hawaii_2048.tif
jpeg=(--co QUALITY=85 --overwrite --quiet)
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

# usage: draw NAME DEM OPTIONS...: one relief, if its elevation model is there
draw() {
    local picture=$gallery/$1 dem=$2
    shift 2
    [ -e "$dem" ] || { echo "no $dem: $picture stays as it is"; return; }
    "$duskline" relief "$dem" "$picture" "${jpeg[@]}" "$@"
    rm -f "$picture.aux.xml"
    echo "$picture"
}

# usage: project NAME DEM OPTIONS...: an elevation model on another grid, if the first is there
project() {
    local projected=$scratch/$1 dem=$2
    shift 2
    [ ! -e "$dem" ] || gdalwarp -q "$@" "$dem" "$projected"
}

# usage: shrink FROM TO FORMAT: a picture of 640 pixels
shrink() {
    gdal_translate -q -of "$3" -outsize 640 640 -r average "$1" "$gallery/$2" --config GDAL_PAM_ENABLED NO
    echo "$gallery/$2"
}

evening=2026-12-21T17:25-10:00
draw hawaii.jpg $hawaii --time $evening --size 1024
draw hawaii_morning.jpg $hawaii --time 2026-12-21T07:25-10:00 --size 480
draw hawaii_noon.jpg $hawaii --time 2026-12-21T12:20-10:00 --size 480
draw hawaii_evening.jpg $hawaii --time $evening --size 480

"$duskline" relief $hawaii "$scratch/whole.tif" --time $evening --quiet
gdal_translate -q -of JPEG -co QUALITY=85 -srcwin 800 450 640 640 "$scratch/whole.tif" \
    $gallery/hawaii_detail.jpg --config GDAL_PAM_ENABLED NO
echo $gallery/hawaii_detail.jpg

"$duskline" shadow $hawaii "$scratch/mask.png" --time $evening --quiet
shrink "$scratch/mask.png" hawaii_mask.png PNG
"$duskline" shadow $hawaii "$scratch/heights.tif" --heights --time $evening --quiet
draw hawaii_shadow_heights.jpg "$scratch/heights.tif" --palette atlas --flat --exaggeration 3 \
    --azimuth 315 --altitude 60 --size 640

"$duskline" shadow $hawaii "$scratch/beacons.tif" --count --point 241312.5,2193787.5,+30 \
    --point 226387.5,2155387.5,+30 --quiet
gdal_translate -q -of PNG -ot Byte -outsize 640 640 -r average -scale 0 2 20 255 "$scratch/beacons.tif" \
    $gallery/hawaii_beacons.png --config GDAL_PAM_ENABLED NO
echo $gallery/hawaii_beacons.png

project fuji.tif "$terrains/fuji/mt_fuji_90m.tif" -t_srs EPSG:32654 -te 257000 3880500 315000 3938500 \
    -tr 75 75 -r average
draw fuji.jpg "$scratch/fuji.tif" --time 2026-12-21T15:50+09:00 --size 640
draw sierra.jpg "$terrains/lakes/sierra_30m_1100.tif" --time 2026-06-21T19:00-07:00 --size 640
draw san_gabriel.jpg "$terrains/bigtujunga/bigtujunga.tif" --time 2026-12-21T08:00-08:00 --size 1000
project moon.tif "$terrains/moon/moon_tycho_2048.tif" -r bilinear \
    -t_srs '+proj=laea +lat_0=-43.3 +lon_0=-11.2 +R=1737400' -te -430000 -330000 190000 290000 -tr 400 400
draw moon.jpg "$scratch/moon.tif" --azimuth 80 --altitude 13 --size 800

for palette in natural atlas alpine desert; do
    draw palette_$palette.jpg "$terrains/lakes/sierra_30m_1100.tif" --palette $palette --azimuth 315 \
        --altitude 30 --size 360
done

# Light maps: one of evening light under a blue sky, and the models side by side.
tujunga="$terrains/bigtujunga/bigtujunga.tif"
[ ! -e "$tujunga" ] || "$duskline" light "$tujunga" $gallery/san_gabriel_light.jpg "${jpeg[@]}" --soft \
    --light azimuth=225,altitude=12,colour=#ffd9a0,strength=1.1 --ambient 0.3 --ambient-colour '#7aa0ff'
rm -f $gallery/san_gabriel_light.jpg.aux.xml
left=0
for model in lambert half-lambert hillshade; do
    "$duskline" light $hawaii "$scratch/$model.tif" --model $model --azimuth 315 --altitude 25 --quiet
    gdal_translate -q -srcwin 500 120 300 300 -a_ullr $left 300 $((left + 300)) 0 "$scratch/$model.tif" \
        "$scratch/part_$left.tif"
    left=$((left + 308))
done
gdalbuildvrt -q -vrtnodata 255 "$scratch/models.vrt" "$scratch"/part_*.tif
gdal_translate -q -of PNG -a_nodata none "$scratch/models.vrt" docs/algorithms/light_models.png --config GDAL_PAM_ENABLED NO
echo docs/algorithms/light_models.png

# A section through Mauna Kea along its light, and where the inexact casters differ from the truth.
algorithms=docs/algorithms
"$duskline" shadow $hawaii "$scratch/section.tif" --heights --caster sweep --azimuth 270 --altitude 4 --flat --quiet
for part in $hawaii "$scratch/section.tif"; do
    gdal_translate -q -of XYZ -srcwin 160 690 1600 2 "$part" "$scratch/$(basename "$part" .tif).xyz"
done
tools/draw_profile.py "$scratch/hawaii_2048.xyz" "$scratch/section.xyz" 4 $algorithms/sweep_section.svg
echo $algorithms/sweep_section.svg
for caster in fast-ray sweep smap strider line-march line-march-bilinear; do
    "$duskline" shadow $hawaii "$scratch/$caster.tif" --caster $caster --azimuth 203 --altitude 5 --flat --quiet
    [ $caster = fast-ray ] && continue
    tools/compare_masks.py "$scratch/fast-ray.tif" "$scratch/$caster.tif" --part 1240,560,120,120 --zoom 5 \
        --picture $algorithms/${caster}_difference.png >/dev/null || [ $? = 1 ] # 1: they differ
    echo $algorithms/${caster}_difference.png
done
