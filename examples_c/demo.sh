#!/bin/sh
# Dresses every body of the sample in its jacket: demo.sh RETARGET SAMPLE_FOLDER
set -eu
retarget=$1
sample=$2

jacket="$sample/jacket"
for body in "$sample"/*/avatar.obj; do
    folder=$(dirname "$body")
    name=$(basename "$folder")
    set -- --garment "$jacket/garment.obj" --source-skeleton "$sample/skeleton.obj" --source-avatar "$sample/mannequin.obj" \
        --avatar "$body" --target-skeleton "$folder/skeleton.obj" --report "$folder/report.json" -o "$folder/dressed.obj"
    [ ! -f "$folder/skin.txt" ] || set -- "$@" --skin-weights "$folder/skin.txt"
    [ ! -f "$jacket/no-fit.txt" ] || set -- "$@" --no-fit "$jacket/no-fit.txt"
    echo "== the jacket on $name"
    "$retarget" "$@"
    grep -E '"(seconds|min_distance|intersections)":' "$folder/report.json" | grep -v '{ "seconds"' || true
    echo "   $folder/dressed.obj, beside $body"
done
