#!/bin/sh
# performance.sh DIRECTORY FILE [TABLE...]: runs the speed benchmarks of a build and writes their tables to FILE, whole
# or not at all. Tables are kept in DIRECTORY/tables; with names of tables only those are measured anew, for machines
# that are quiet for a minute at a time. `cmake --build build/default --target performance` measures all: two to
# three minutes; leave the machine alone meanwhile.
set -eu
programs=$1
page=$2
shift 2
all='roofline step_3d step_2d step_1d crossing memory scaling compile_time'
new=$page.new
tables=$programs/tables
mkdir -p "$tables"
trap 'rm -f "$new" "$tables"/*.new' EXIT

measure() { "$programs/$1" 2> /dev/null | grep -v -e '^Run on' -e '^--' -e '^Benchmark ' -e '/repeats:' -e '^\*\*\*' ; }

load=$(cut -d ' ' -f 1 /proc/loadavg 2> /dev/null || echo unknown)
for table in ${*:-$all}; do
    measure "$table" > "$tables/$table.new"
    mv "$tables/$table.new" "$tables/$table"
done

processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2> /dev/null | head -n 1)
family=$(sed -n 's/^cpu family[^:]*: //p' /proc/cpuinfo 2> /dev/null | head -n 1)
cores=$(getconf _NPROCESSORS_ONLN)

{
    echo '# Performance'
    echo
    echo 'Written by `cmake --build build/default --target performance`, on' "$(date +%Y-%m-%d)."
    echo "Machine: ${processor:-unknown}${family:+ of family $family}, $cores processors, load $load when the last tables were" \
         "begun; $("${CXX:-c++}" --version | head -n 1), the default preset's flags (-O3 -march=native, no -ffast-math)."
    echo
    echo 'Nanoseconds are per particle and step, of processor time, medians of five interleaved runs; a ratio is to the'
    echo 'step named beside it, in the same run. Compare ratios; nanoseconds move with the load.'
    for table in $all; do
        echo
        case $table in
            roofline) echo '## What one core can do' ;;
            step_3d) echo '## 3D' ;;
            step_2d) echo '## 2D' ;;
            step_1d) echo '## 1D' ;;
            crossing) echo '## Particles that change cells' ;;
            memory) echo '## Memory' ;;
            scaling) echo '## Threads' ;;
            compile_time) echo '## Compiling' ;;
        esac
        echo
        echo '```text'
        cat "$tables/$table" 2> /dev/null || echo 'not measured'
        echo '```'
        case $table in
            roofline) cat << 'END'

A 3D quadratic FLIP step in double precision moves 112 bytes of each particle in and out of the core once and in once
more: 336 bytes; where passes are run together, slab by slab (docs/storage.md, Waves), 224 of them come from memory or go
there. It takes some 900 multiplications and additions, most of them fused. The larger of the two, divided by
the rates above, is the time below which no step of two sweeps can come; the sum is what it takes if loads do not
overlap with arithmetic.
END
            ;;
            step_3d) cat << 'END'

What bounds it: arithmetic and its operands, and with eight lanes memory too, once the particles are beyond the caches. A
particle takes 411 instructions (quadratic FLIP, g++ 12, AVX2, by `benchmarks/count_instructions.sh`): arithmetic, loads that
do not fold into it, shifts of rows, and what sixteen registers cannot hold. Bytes: 112 a particle and 56 a
node (float: half).
END
            ;;
            step_2d) cat << 'END'

FMPM(4) with linear functions assembles the mass matrix, so that a term is a pass over nodes and no sweep
(docs/method.md). The step needs 72 bytes a node instead of 40, with the assembled matrix 112 or more.
END
            ;;
            crossing) cat << 'END'

Most of it is not crossing itself. A tile has as many slots as its fullest lane, and particles that have wandered fill
lanes unevenly: a step is longer by the inverse of the occupancy. "Stopped" is the block at rest where it had drifted to;
crossing is what is beyond it. The step by hand has full tiles and nobody who crosses.
The worst case is a jet of scattered single particles: one lane of each slot is in use, and a particle costs as much as W.
END
            ;;
            memory) cat << 'END'

Peak of a process over the size of the fields of its particles and nodes: once the body is made, from a list of points,
and after the steps. Particles that cross cells need more: tiles keep spare slots, letters lie beside them, and while tiles
are tidied both copies exist.
END
            ;;
            scaling) cat << 'END'

Threads share the slabs of a body, each with its own run of them, about the one whose memory it was the first to write.
Neighbours begin side by side or meet at their ends, and wait for each other there only; results are those of one thread,
bit for bit.

"Apart" is the gain of as many blocks of the same size as there are threads, each stepped by a thread of its own, all at
the same time: they never wait for each other, but share the memory.

Nanoseconds of the clock here, medians of nine.
END
            ;;
            compile_time) cat << 'END'

A program that includes everything, makes a body and steps it (`benchmarks/support/one_solver.cpp`): seconds of the clock, the
median of three.
END
            ;;
        esac
    done
} > "$new"
mv "$new" "$page"
trap - EXIT
