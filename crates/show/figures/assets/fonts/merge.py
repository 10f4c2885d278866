"""Adds the mathematical signs to a Noto Sans subset, names the result Motiform Sans, writes .ttf and .woff2."""
import sys

from fontTools.merge import Merger
from fontTools.ttLib import TTFont

text, maths, style, out = sys.argv[1:]
font = Merger().merge([text, maths])
source = TTFont(text)
font["name"] = source["name"]
for record in font["name"].names:
    value = {1: "Motiform Sans", 2: style, 3: f"Motiform Sans {style}; from Noto Sans 2.004",
             4: f"Motiform Sans {style}", 6: f"MotiformSans-{style}"}.get(record.nameID)
    if value:
        record.string = value
font["hhea"].ascent, font["hhea"].descent = source["hhea"].ascent, source["hhea"].descent
font["OS/2"], font["post"].italicAngle = source["OS/2"], source["post"].italicAngle
font["head"].macStyle = source["head"].macStyle
font["head"].created = font["head"].modified = source["head"].modified
font.recalcTimestamp = False
font.save(out + ".ttf")
font.flavor = "woff2"
font.save(out + ".woff2")
