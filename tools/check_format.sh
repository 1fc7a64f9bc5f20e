#!/usr/bin/env bash
# Says which sources clang-format would change; exits with 1 if there are any, 77 where it cannot tell.
#
# usage: tools/check_format.sh          check
#        tools/check_format.sh --fix    format them
set -euo pipefail
cd "$(dirname "$0")/.."

# Other versions lay out some lines otherwise; .clang-format is written for this one.
version=14
for clang_format in clang-format-$version clang-format ""; do
    [ -n "$clang_format" ] || { echo "skipped: no clang-format $version here"; exit 77; }
    [[ $("$clang_format" --version 2>/dev/null) =~ version\ $version\. ]] && break
done

mapfile -t files < <(find src apps tests bench examples fuzz \( -name '*.h' -o -name '*.cpp' -o -name '*.inl' \) 2>/dev/null | sort)
if [ "${1:-}" = --fix ]; then
    "$clang_format" -i "${files[@]}"
else
    "$clang_format" --dry-run --Werror "${files[@]}"
fi
