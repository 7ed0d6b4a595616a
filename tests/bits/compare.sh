#!/bin/sh
# sh tests/bits/compare.sh [OPTION...] REVISION|FOLDER [PART...]: do the headers of this checkout give, bit for bit,
# what those of REVISION of git give, or those in FOLDER (the one that holds tamis/)? One line per composition, of those
# whose names have a PART if there are any. Exit code 1 if one differs, 2 if there was nothing to compare.
#
#   --cache FOLDER   what is built is kept there (build/bits). A side is built once: the name it is kept under is made
#                    of its headers, this program, the compiler and the flags
#   --mine FOLDER    these headers in place of this checkout's
#   --flags FLAGS    in place of "-O1 -march=native -fopenmp -DNDEBUG"
#   --jobs N         compilers at the same time (1)
#   --only-build     no run
#
# The compiler is $CXX (g++); where Eigen is, is said by $TAMIS_INCLUDES, by default pkg-config for Eigen.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
usage() {
    sed -n '2,/^set/{s/^# \{0,1\}//;/^set/d;p;}' "$0" >&2
    exit 2
}
complain() {
    echo "compare.sh: $1" >&2
    exit 2
}

cache=$root/build/bits mine=$root/include flags='-O1 -march=native -fopenmp -DNDEBUG' jobs=1 run=yes
while [ $# -gt 0 ]; do
    case $1 in
        --cache | --mine | --flags | --jobs)
            [ $# -gt 1 ] || usage
            case $1 in
                --cache) cache=$2 ;;
                --mine) mine=$2 ;;
                --flags) flags=$2 ;;
                --jobs) jobs=$2 ;;
            esac
            shift 2
            ;;
        --only-build) run=no && shift ;;
        -*) usage ;;
        *) break ;;
    esac
done
[ $# -gt 0 ] || usage
wanted=$1
shift
compiler=${CXX:-g++}
includes=${TAMIS_INCLUDES-$(pkg-config --cflags eigen3 2> /dev/null || echo -I/usr/include/eigen3)}
mkdir -p "$cache"
cache=$(cd "$cache" && pwd)

# The headers of a revision are taken out of git once.
if [ -f "$wanted/tamis/tamis.hpp" ]; then
    other=$wanted
elif commit=$(git -C "$root" rev-parse --verify --quiet "$wanted^{commit}"); then
    other=$cache/headers/$commit/include
    if [ ! -d "$other" ]; then
        mkdir -p "$cache/headers"
        rm -rf "$cache/headers/$commit.new"
        mkdir "$cache/headers/$commit.new"
        git -C "$root" archive "$commit" include | tar -x -C "$cache/headers/$commit.new"
        mv "$cache/headers/$commit.new" "$cache/headers/$commit"
    fi
else
    complain "$wanted is no revision of git, and no folder with tamis/tamis.hpp"
fi
[ -f "$mine/tamis/tamis.hpp" ] || complain "$mine has no tamis/tamis.hpp"

sums() { (cd "$1" && find . \( -name '*.hpp' -o -name '*.cpp' \) -type f | LC_ALL=C sort | xargs sha256sum); }

# build INCLUDE: sets `built` to where its program is.
build() {
    key=$({ sums "$1/tamis" && sums "$here" && echo "$flags $includes" && $compiler --version; } | sha256sum)
    key=$(echo "$key" | cut -c 1-16)
    built=$cache/$key
    [ -x "$built/bits" ] && return
    mkdir -p "$built"
    echo "building with $1, in $built" >&2
    for source in "$here"/*.cpp; do
        name=$(basename "$source" .cpp)
        [ -f "$built/$name.o" ] || echo "$name"
    done > "$built/missing.$$"
    # An object is there when it is whole: a build that was broken off goes on from there, and two at once do no harm.
    start=$(date +%s)
    one_object="$compiler -std=c++20 $flags -w -I'$1' $includes -c '$here/NAME.cpp' -o '$built/NAME.$$.new'"
    # 255 stops xargs: no other source is begun.
    xargs -P "$jobs" -I NAME sh -c "$one_object && mv '$built/NAME.$$.new' '$built/NAME.o' || exit 255" \
        < "$built/missing.$$" ||
        complain "$1 does not compile, see above"
    $compiler $flags "$built"/*.o -o "$built/bits.$$.new" || complain "$1 does not link, see above"
    mv "$built/bits.$$.new" "$built/bits"
    rm -f "$built/missing.$$"
    echo "built in $(($(date +%s) - start)) s" >&2
}
build "$other"
one=$built
build "$mine"
two=$built
[ $run = yes ] || exit 0

# Both sides run, even if they are one program: runs by threads must agree as well.
work=$(mktemp -d "$cache/run.XXXXXX")
trap 'rm -rf "$work"' EXIT
failed=0
for side in one two; do
    if [ $side = one ]; then program=$one/bits; else program=$two/bits; fi
    "$program" "$work/$side" "$@" > "$work/$side.log" || failed=$?
    [ -d "$work/$side" ] || complain "nothing was run: $(cat "$work/$side.log")"
    # Sentences about compositions that do not show what they are there for.
    if [ $failed -ne 0 ]; then
        grep -B 1 '^    ' "$work/$side.log" | grep -v '^--' | sed "s/^/$side: /" >&2 || true
    fi
done
[ $failed -lt 2 ] || exit 2

differ=0 count=0 noted=0
for file in $(ls "$work/one" "$work/two" | grep -v -e ':$' -e '^$' | sort -u); do
    count=$((count + 1))
    if [ ! -f "$work/one/$file" ] || [ ! -f "$work/two/$file" ]; then
        said='only one side has it'
        differ=$((differ + 1))
    elif cmp -s "$work/one/$file" "$work/two/$file"; then
        said=same
    else
        said=$(python3 "$here/difference.py" "$work/one/$file" "$work/two/$file") || differ=$((differ + 1))
        case $said in same*) noted=$((noted + 1)) ;; esac
    fi
    printf '%-64s %s\n' "$file" "$said"
done
[ $count -gt 0 ] || complain 'no composition was run'
if [ $differ -eq 0 ]; then
    echo "all $count are the same$([ $noted -eq 0 ] || echo ", $noted of them in what both sides tell")"
else
    echo "$differ of $count differ"
fi
[ $differ -eq 0 ] && [ $failed -eq 0 ]
