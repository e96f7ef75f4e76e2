#!/usr/bin/env bash
# Checks how programs, shared libraries and static libraries (ELF) are hardened, and says what is missing; status 1 then.
#   packaging/hardened.sh linked FILE...    position independent, all relocations read-only and resolved at the start
#                                           (RELRO, NOW), no executable stack, no memory both writable and executable
#   packaging/hardened.sh full FILE...      also stack protector, fortified calls of the C library, no search path and, on
#                                           x86, marked targets of indirect branches (IBT)
# A program has a stack protector also from static libraries of others; its own archives (.a), with `full`, show what its
# own code has. They need not have a call that can be fortified. The note that tells the kernel of IBT and shadow stacks is wanted of linked files
# only where the C library's start files have it, as the linker drops it otherwise: Debian 12's have none.
set -euo pipefail
kind=${1?linked or full}
shift
missing=0
want() {  # what, command...
    "${@:2}" || { echo "hardened.sh: $file: $1" >&2; missing=1; }
}
has() { grep -qE "$1" <<<"$2"; }
lacks() { ! has "$@"; }
x86() { has 'Machine:.*X86-64' "$(readelf -hW "$file" 2>/dev/null)"; }

# Code of start files alone has fewer than 20.
marked() { (($(LC_ALL=C grep -oaP '\xf3\x0f\x1e\xfa' "$file" | wc -l) > 20)); }
startHasNote() {
    local start
    start=$(cc -print-file-name=crt1.o 2>/dev/null) && readelf -nW "$start" 2>/dev/null | grep -q IBT
}
everyMemberHasNote() {
    (($(readelf -nW "$file" | grep -c 'IBT, SHSTK') == $(ar t "$file" | wc -l)))
}

linked() {
    local head segments dynamic
    head=$(readelf -hW "$file")
    segments=$(readelf -lW "$file")
    dynamic=$(readelf -dW "$file")
    want "is not position independent" has 'Type: *DYN' "$head"
    want "has no read-only relocations (RELRO)" has GNU_RELRO "$segments"
    want "resolves symbols late (no BIND_NOW)" has '\(FLAGS(_1)?\).*NOW|\(BIND_NOW\)' "$dynamic"
    want "says nothing of its stack, which is executable then" has GNU_STACK "$segments"
    want "has an executable stack" lacks 'GNU_STACK.* RWE ' "$segments"
    want "has memory that is writable and executable" lacks 'LOAD.* RWE ' "$segments"
    [[ $kind == full ]] || return 0
    want "has a search path for libraries" lacks '\((RPATH|RUNPATH)\)' "$dynamic"
}

protected() { want "has no stack protector" has '__stack_chk_fail' "$1"; }  # symbols

for file; do
    [[ -f $file ]] || { echo "hardened.sh: $file: there is no such file" >&2; exit 1; }
    if [[ $file == *.a ]]; then
        protected "$(nm -u "$file")"
        ! x86 || want "has objects without marked branch targets and shadow stacks" everyMemberHasNote
        continue
    fi
    linked
    [[ $kind == full ]] || continue
    symbols=$(readelf -W --dyn-syms "$file" | awk '{ print $8 }')
    protected "$symbols"
    want "has no fortified calls" has '_chk(@|$)' "$symbols"
    x86 || continue
    want "has no marked branch targets (-fcf-protection)" marked
    if startHasNote; then
        want "has no note of IBT and SHSTK" has 'IBT, SHSTK' "$(readelf -nW "$file")"
    fi
done
exit "$missing"
