#!/bin/bash
# Looks into the object files for code that would run on a CPU that cannot run it, or give other bits there:
#   tools/check_isa_objects.sh build/release/isa_objects.txt
# The manifest has lines `<namespace or baseline> <object file>`. Kernels must keep every symbol the linker may merge inside
# their own namespace, initialise nothing at start, and contain only instructions of their ISA and no fused multiply-add, but
# in namespaces that end in _fast.
# Prints one line per finding; exit status 1 if there is one.
set -euo pipefail
manifest=${1:?usage: check_isa_objects.sh <manifest>}
findings=0
finding() {
    echo "$1"
    findings=$((findings + 1))
}

# What must not appear in a disassembly, as extended regular expressions on "mnemonic operands".
vex='^(v[a-z]|k(mov|or|and|not|xor|shift|test|unpck|add)[a-z]*[bwdq] |andn |bextr |bls[ir] |blsmsk |bzhi |mulx |pdep |pext |rorx |s[ah][lr]x |shlx )'
lzcnt='^lzcnt '
sse4='^(popcnt |crc32|ptest |round[sp][sd] |dpp[sd] |(blend|pblend)[a-z]+ |p(ext|ins)r[bdq] |extractps |insertps |pm(in|ax)(s[bd]|u[wd]) |pmul(dq|ld) |pmov[sz]x[a-z]+ |pcmp(eqq|gtq|[ei]str[im]) |packusdw |movntdqa )'
sse3='^(pshufb |ph(add|sub)[a-z]+ |h(add|sub)p[sd] |addsubp[sd] |mov(ddup|s[hl]dup) |lddqu |palignr |pabs[bwd] |psign[bwd] |pmaddubsw |pmulhrsw )'
avx512='%zmm|%k[0-7]|%[xy]mm(1[6-9]|2[0-9]|3[01])|\{1to'
fma='^vfn?m(add|sub)(add|sub)?(132|213|231)[ps][sdh] '

forbidden() {
    case "$1" in
    baseline | scalar | reference) echo "$vex|$lzcnt|$sse4|$sse3|$fma" ;;
    sse42 | sse42_precise) echo "$vex|$lzcnt|$fma" ;;
    avx2 | avx2_precise) echo "$avx512|$lzcnt|$fma" ;;
    avx2_fast) echo "$avx512|$lzcnt" ;;
    avx512_fast) echo "$lzcnt" ;;
    *) echo "$lzcnt|$fma" ;;
    esac
}

# Symbols of an object as "type mangled-name", defined ones.
defined() { nm --defined-only --format=posix "$1" | awk '{print $2, $1}'; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
while read -r isa object; do
    [ -n "$object" ] || continue
    [ -r "$object" ] || { echo "$object: cannot be read"; exit 1; }
    where=$isa/${object##*/}

    objdump -d --no-show-raw-insn "$object" | awk -F '\t' 'NF > 1 {print $2}' | sed -E 's/^((data16|rep|repz|repnz|lock|notrack) )+//' \
        >"$work/code"
    pattern=$(forbidden "$isa")
    instruction=$(grep -m 1 -E "$pattern" "$work/code" || true)
    if [ -n "$instruction" ]; then
        finding "$where: $(grep -c -E "$pattern" "$work/code") forbidden instructions, the first is: $instruction"
    fi

    [ "$isa" = baseline ] && { defined "$object" | awk '$1 ~ /[VWu]/ {print $2}' | sort -u >>"$work/baseline.weak"; continue; }

    # The linker keeps one of the copies of a weak symbol, so those of an ISA must carry its name; so must all that is global.
    # Two precisions of one ISA may share what is not ours: the flags are the same.
    flags=${isa%_fast}
    defined "$object" | awk '$1 ~ /[VWu]/ {print $2}' | sort -u >>"$work/${flags%_precise}.weak"
    # Our namespace, or what xsimd instantiates for exactly one architecture, where a debug build does not inline it; no two
    # ISAs share one of those either, see below.
    while read -r type name; do
        case "$type$name" in
        ?_ZN8lanecast"${#isa}$isa"* | ?_ZNK8lanecast"${#isa}$isa"*) ;;
        [VW]_ZN*5xsimd* | [VWu]_Z*"8lanecast${#isa}$isa"*) ;;
        [VW]DW.ref.* | [VW]__x86.get_pc_thunk*) ;;
        *) finding "$where: symbol outside lanecast::$isa: $(c++filt "$name")" ;;
        esac
    done < <(defined "$object" | grep -E '^[A-Zu] ' || true)

    sections=$(objdump -h "$object" | awk '$2 ~ /^\.(init_array|ctors|preinit_array)/ {print $2}' | head -n 1)
    [ -z "$sections" ] || finding "$where: section $sections, so code that runs before the CPU was asked"
    ! nm "$object" | grep -q '__cxa_guard' || finding "$where: __cxa_guard, so a static local with an initialiser"
    ! objdump -h "$object" | grep -q '\.gnu\.lto_' || finding "$where: compiled with LTO"
done <"$manifest"

# No weak symbol in two of the lists.
for list in "$work"/*.weak; do
    [ -e "$list" ] && sort -u "$list"
done | sort | uniq -d >"$work/shared"
while read -r name; do
    holders=$(cd "$work" && grep -l -x -F -- "$name" ./*.weak | sed 's|\./||; s|\.weak||' | tr '\n' ' ')
    finding "shared by ${holders% }: $(c++filt "$name")"
done <"$work/shared"

[ "$findings" -eq 0 ]
