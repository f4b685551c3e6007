#!/bin/sh
# The C programs under AddressSanitizer with UndefinedBehaviourSanitizer, then under valgrind, linked with the library as
# it is released: sanitize.sh BUILD_FOLDER SAMPLE_FOLDER
#
# Walks success, cancel and every kind of error; nothing may be reported, and nothing may be lost. CC and CFLAGS apply.
set -eu
build=$1
sample=$2
tests=$(dirname "$0")
root=$tests/../..
work=$build/sanitize
mkdir -p "$work/tubes"

flags="-std=c99 -pedantic -Wall -Wextra -Werror -I$root/include -g"
libraries="-L$build -lbespoke -lm -lpthread"
compile() { # NAME FLAGS...: both programs
    name=$1
    shift
    # The words of the flags are to be split.
    # shellcheck disable=SC2086
    for program in retarget lifecycle; do
        case $program in
        retarget) sources=$(ls "$root"/examples_c/*.c) ;;
        lifecycle) sources=$tests/lifecycle.c ;;
        esac
        ${CC:-cc} $flags "$@" $sources -o "$work/$program-$name" $libraries '-Wl,-rpath,$ORIGIN/..'
    done
}

# A sleeve, a thicker arm and their skeleton, small enough for valgrind.
tube() { # RADIUS REACH RINGS
    awk -v radius="$1" -v reach="$2" -v rings="$3" 'BEGIN {
        around = 8
        for (r = 0; r < rings; r++)
            for (s = 0; s < around; s++)
                printf "v %.6f %.6f %.6f\n", radius * sin(6.283185307 * s / around), reach * (2 * r / (rings - 1) - 1), \
                    radius * cos(6.283185307 * s / around)
        for (r = 0; r < rings - 1; r++)
            for (s = 0; s < around; s++) {
                a = r * around + s + 1
                b = r * around + (s + 1) % around + 1
                printf "f %d %d %d\nf %d %d %d\n", a, b, b + around, a, b + around, a + around
            }
    }'
}
tube 0.3 0.5 5 >"$work/tubes/garment.obj"
tube 0.4 0.9 8 >"$work/tubes/avatar.obj"
tube 0.2 0.9 8 >"$work/tubes/mannequin.obj"
printf 'v 0 -1 0\nv 0 0 0\nv 0 1 0\nl 1 2\nl 2 3\n' >"$work/tubes/skeleton.obj"
awk 'BEGIN { for (j = 0; j < 3; j++) { for (v = 0; v < 64; v++) printf "%d ", int(v * 3 / 64) == j; print "" } }' >"$work/tubes/skin.txt"
printf '0 1 2 3\n' >"$work/tubes/no-fit.txt"
# What is wrong in each of these is in its name.
printf 'v 0 0 0\nv 1 0 0\nv nan 0 0\nf 1 2 3\n' >"$work/tubes/not-a-number.obj"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n' >"$work/tubes/index-out-of-range.obj"
printf 'v 0 0\nf 1\nq' >"$work/tubes/cut-off.obj"
printf 'v 0 0 0\nv 0 1 0\nl 1 2\n' >"$work/tubes/another-skeleton.obj"
: >"$work/tubes/empty.obj"
printf '1 0 2\n1 0\n' >"$work/tubes/ragged.txt"
printf '1 -0.5 x\n' >"$work/tubes/words.txt"
printf '100000\n' >"$work/tubes/no-such-vertex.txt"

# expect STATUS COMMAND...
expect() {
    expected=$1
    shift
    status=0
    "$@" >"$work/output.txt" 2>&1 || status=$?
    if [ "$status" != "$expected" ] || grep -q 'runtime error:' "$work/output.txt"; then
        cat "$work/output.txt" >&2
        echo "sanitize: exit $status instead of $expected: $*" >&2
        exit 1
    fi
}

# every_end LAUNCHER PROGRAM: success and every error of the command line, files and session. LAUNCHER may be empty.
every_end() {
    launcher=$1
    retarget=$2
    in=$work/tubes
    run() { # STATUS OPTIONS...: the tubes, with options that replace or add; the last of an option counts
        status=$1
        shift
        # The words of the launcher are to be split.
        # shellcheck disable=SC2086
        expect "$status" $launcher "$retarget" --quiet --garment "$in/garment.obj" --source-skeleton "$in/skeleton.obj" \
            --avatar "$in/avatar.obj" --target-skeleton "$in/skeleton.obj" --voxel 0.1 --threads 2 -o "$work/out.obj" "$@"
    }
    run 0
    run 0 --source-avatar "$in/mannequin.obj" --skin-weights "$in/skin.txt" --no-fit "$in/no-fit.txt" \
        --output-avatar "$work/out-avatar.obj" --report "$work/report.json"
    run 0 --curvature-weight 2 --inflation-dhat 0.02 --min-separation 1e-6 --keep-partial "$work/partial.obj"
    run 1 --max-iterations 1 --report "$work/report.json" --keep-partial "$work/partial.obj"
    run 1 --garment "$in/missing.obj" --report "$work/report.json" --keep-partial "$work/partial.obj"
    run 0 --help
    run 0 --version
    for bad in not-a-number index-out-of-range cut-off empty missing; do
        run 1 --garment "$in/$bad.obj"
        run 1 --avatar "$in/$bad.obj"
        run 1 --source-avatar "$in/$bad.obj"
        run 1 --target-skeleton "$in/$bad.obj"
    done
    run 1 --source-skeleton "$in/another-skeleton.obj"
    for bad in ragged words missing; do
        run 1 --skin-weights "$in/$bad.txt"
    done
    run 1 --no-fit "$in/no-such-vertex.txt"
    run 1 --no-fit "$in/words.txt"
    run 1 --garment "$in/mannequin.obj" --source-skeleton "$in/avatar.obj"
    run 1 --dhat 5
    run 1 --voxel 1e9
    run 1 -o "$work/no/such/folder.obj"
    run 2 --no-such-option
    run 2 --fit-weight much
    run 2 --threads 1e9
    run 2 --report
}

# Ctrl-C in the middle of a run. It may come before the program has begun, or after its end; `stopped` counts the others.
interrupt() { # SECONDS COMMAND...
    seconds=$1
    status=0
    timeout --preserve-status --signal=INT "$@" >"$work/output.txt" 2>&1 || status=$?
    if [ "$status" != 130 ] && [ "$status" != 0 ] || grep -q 'runtime error:' "$work/output.txt"; then
        cat "$work/output.txt" >&2
        echo "sanitize: exit $status after an interrupt: $*" >&2
        exit 1
    fi
    ! grep -q 'stopped by Ctrl-C' "$work/output.txt" || stopped=$((stopped + 1))
    echo "   interrupted after $seconds s: exit $status"
}

in_time() {
    if [ "$stopped" = 0 ]; then
        echo "sanitize: no interrupt came in time" >&2
        exit 1
    fi
}

export ASAN_OPTIONS=detect_leaks=1:abort_on_error=0:exitcode=9
export UBSAN_OPTIONS=print_stacktrace=1
echo "== AddressSanitizer, UndefinedBehaviourSanitizer"
compile sanitized -O1 -fsanitize=address,undefined -fno-sanitize-recover=all
expect 0 "$work/lifecycle-sanitized"
every_end "" "$work/retarget-sanitized"
set -- "$work/retarget-sanitized" --garment "$sample/jacket/garment.obj" --source-skeleton "$sample/skeleton.obj" \
    --source-avatar "$sample/mannequin.obj" --avatar "$sample/heavy/avatar.obj" \
    --target-skeleton "$sample/heavy/skeleton.obj" --skin-weights "$sample/heavy/skin.txt" \
    --no-fit "$sample/jacket/no-fit.txt" --report "$work/report.json" --keep-partial "$work/partial.obj" -o "$work/jacket.obj"
expect 0 "$@"
stopped=0
for seconds in 0.05 0.3 1 2; do
    interrupt "$seconds" "$@"
done
in_time

echo "== valgrind"
compile plain -O1
valgrind="valgrind --quiet --leak-check=full --errors-for-leak-kinds=definite --show-leak-kinds=definite --error-exitcode=9"
# shellcheck disable=SC2086
expect 0 $valgrind "$work/lifecycle-plain"
every_end "$valgrind" "$work/retarget-plain"
stopped=0
# How long valgrind takes to begin depends on what else the machine does.
for seconds in 5 15 45; do
    # shellcheck disable=SC2086
    [ "$stopped" != 0 ] || interrupt "$seconds" $valgrind "$work/retarget-plain" \
        --garment "$sample/jacket/garment.obj" --source-skeleton "$sample/skeleton.obj" \
        --avatar "$sample/heavy/avatar.obj" --target-skeleton "$sample/heavy/skeleton.obj" -o "$work/jacket.obj"
done
in_time
echo "sanitize: clean"
