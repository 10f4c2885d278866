#!/bin/sh
# Makes the figure fonts from upstream Noto Sans. Usage: sh make.sh FOLDER_WITH_NOTO_TTF_FILES
# Needs: pip install fonttools brotli
set -eu
noto=$1
work=$(mktemp -d)
text='U+0020-007E,U+00A0-00FF,U+0151,U+0391-03A1,U+03A3-03A9,U+03B1-03C9,U+03D1,U+03D5,U+03F5,U+2009,U+2013,U+2014,U+2018,U+2019,U+201C,U+201D,U+2022,U+2026,U+202F,U+2032,U+2033,U+2070,U+2074-207B,U+2080-208B,U+210F,U+2113'
maths='U+2190-2194,U+21A6,U+2202,U+2207,U+2208,U+2211,U+2212,U+221A,U+221D,U+221E,U+2225,U+222B,U+2248,U+2260,U+2261,U+2264,U+2265,U+226A,U+226B,U+22C5,U+27E8,U+27E9'
subset() { # input unicodes output
    pyftsubset "$1" --unicodes="$2" --output-file="$3" --layout-features='' --no-hinting --desubroutinize \
        --notdef-outline --name-IDs='0,1,2,3,4,5,6,13,14' --drop-tables+=MATH,GSUB,GPOS,GDEF
}
subset "$noto/NotoSansMath-Regular.ttf" "$maths" "$work/maths.ttf"
for style in Regular Italic; do
    subset "$noto/NotoSans-$style.ttf" "$text" "$work/$style.ttf"
    python3 "$(dirname "$0")/merge.py" "$work/$style.ttf" "$work/maths.ttf" "$style" "MotiformSans-$style"
done
rm -r "$work"
