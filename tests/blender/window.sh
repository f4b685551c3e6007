#!/bin/sh
# Presses the buttons of the extension in Blender's window and takes pictures: window.sh BLENDER ZIP SAMPLE FOLDER
#
# BLENDER is a program that starts Blender 4.2 or later with the arguments that it is given; ZIP the extension, SAMPLE the folder of
# `make demo`; pictures go to FOLDER. It brings its own screen (Xvfb, xwd of x11-apps, convert of ImageMagick).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
blender=$1 zip=$2 sample=$3
mkdir -p "$4"
folder=$(cd "$4" && pwd)
rm -rf "$folder"/*.png "$folder"/*.wanted "$folder/over" "$folder/profile"
mkdir "$folder/profile"

export DISPLAY=":${BESPOKE_DISPLAY:-77}"
Xvfb "$DISPLAY" -screen 0 1600x1400x24 >/dev/null 2>&1 &
screen=$!
trap 'kill $screen 2>/dev/null || true' EXIT
sleep 2
(
    status=0
    BESPOKE_SAMPLE=$sample BLENDER_USER_RESOURCES=$folder/profile timeout -k 10 600 "$blender" \
        --factory-startup --enable-event-simulate -p 0 0 1600 1400 --python "$here/window.py" -- "$zip" "$folder" || status=$?
    echo "$status" >"$folder/over"
) &
while [ ! -f "$folder/over" ]; do
    for wanted in "$folder"/*.wanted; do
        [ -f "$wanted" ] || continue
        xwd -root -silent | convert xwd:- "${wanted%.wanted}.png"
        rm "$wanted"
    done
    sleep 0.1
done
exit "$(cat "$folder/over")"
