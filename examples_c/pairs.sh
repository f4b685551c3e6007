#!/bin/sh
# Dresses every avatar of a folder of real meshes in every garment of it, with the same defaults for all, and prints a
# table: pairs.sh RETARGET ASSETS OUT [options of retarget]
set -eu
retarget=$1
assets=$2
out=$3
shift 3
mkdir -p "$out"

# field KEY FILE: the number behind "KEY" on the first line of FILE that has it.
field() { sed -n "s/.*\"$1\": *\([-0-9.e+]*\).*/\1/p" "$2" | head -n 1; }

printf '%-16s %-14s %8s %10s %6s %12s %12s\n' garment avatar seconds iterations MB distance intersections
failed=0
for garment in "$assets"/garments/*/; do
    for avatar in "$assets"/avatars/*/; do
        pair="$(basename "$garment")_$(basename "$avatar")"
        report="$out/$pair.json"
        skin="" no_fit=""
        [ ! -f "$avatar/skin.txt" ] || skin="--skin-weights"
        [ ! -f "$garment/no-fit.txt" ] || no_fit="--no-fit"
        if ! "$retarget" --garment "$garment/garment.obj" --source-skeleton "$garment/skeleton.obj" \
            --avatar "$avatar/avatar.obj" --target-skeleton "$avatar/skeleton.obj" \
            ${skin:+"$skin" "$avatar/skin.txt"} ${no_fit:+"$no_fit" "$garment/no-fit.txt"} \
            --quiet --report "$report" "$@" -o "$out/$pair.obj"; then
            failed=1
            continue
        fi
        inflate=$(sed -n 's/.*"inflate".*"iterations": \([0-9]*\).*/\1/p' "$report")
        fit=$(sed -n 's/.*"fit".*"iterations": \([0-9]*\).*/\1/p' "$report")
        memory=$(field peak_memory_bytes "$report")
        printf '%-16s %-14s %8.1f %10s %6d %12.5f %12s\n' "$(basename "$garment")" "$(basename "$avatar")" \
            "$(field seconds "$report")" "$inflate + $fit" "$((memory / 1000000))" \
            "$(field garment_avatar "$report")" \
            "$(sed -n 's/.*"intersections": { "garment_garment": \([0-9]*\), "garment_avatar": \([0-9]*\).*/\1 + \2/p' "$report")"
    done
done
exit $failed
