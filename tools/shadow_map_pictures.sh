#!/usr/bin/env bash
# The pictures of docs/algorithms/shadow_mapping.md: box, kernels, fade and penumbra from 15, 50, 100 and 200 m over a
# model of Hawaii at 1 : 40, whose cells are some 2 m wide.
#
# usage: tools/shadow_map_pictures.sh VIEWER DEM FOLDER
set -euo pipefail
[ $# -eq 3 ] || { sed -n '5p' "$0" | cut -c3- >&2; exit 2; }
viewer=$1 dem=$2 folder=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

east=900 north=900
gdal_translate -q -srcwin 500 350 1000 1000 -scale 0 4200 0 105 -ot Float32 -a_srs EPSG:32605 -a_ullr 0 2000 2000 0 \
    "$dem" "$scratch/model.tif"
ground=$(gdallocationinfo -valonly -geoloc "$scratch/model.tif" $east $north)

for height in 15 50 100 200; do
    for overlay in none box kernels fade penumbra; do
        # East and north from the middle of the upper left cell.
        cat > "$scratch/state.json" <<END
{"camera": {"east_m": $((east - 1)), "north_m": $((north - 1999)), "height_m": $(echo "$ground + $height" | bc),
            "heading_deg": 40, "pitch_deg": -12},
 "light": {"azimuth_deg": 300, "altitude_deg": 12}, "technique": "shadow-map"}
END
        "$viewer" "$scratch/model.tif" --state "$scratch/state.json" --shadow-map "overlay=$overlay" --size 320x240 \
            --render "$scratch/$overlay.png" --overwrite --quiet
    done
    convert "$scratch"/{none,box,kernels,fade,penumbra}.png +append "$scratch/$height.png"
done
convert "$scratch"/{15,50,100,200}.png -append -quality 82 "$folder/shadow_map.jpg"
