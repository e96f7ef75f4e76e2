// The images of the built-in scenes: labelled tiles by which reflections are judged, paving, rock, a pierced panel.
#pragma once

#include "scene/builtin/canvas.h"

#include <span>

namespace reflet::builtin {

/// Tiles in a square, columns A, B, ... and rows 1, 2, ... from the top, each with its name: "C4".
struct LabelledTiles {
    uint32_t size = 1024;  ///< pixels a side
    int tiles = 8;         ///< a side
    std::span<const Hex> colors;
    Hex joint = 0x2A2A2E;
    Hex letters = 0xF4EFE6;
    float grain = 4.0F;
    uint32_t seed = 1;  ///< chooses which tile has which colour
};
Image labelledTiles(std::string name, const LabelledTiles& style);

/// A square board of rings, a frame and a label: turned or mirrored pictures of it look different from it.
Image emblem(std::string name, std::string_view label, Hex field, Hex frame, Hex mark);

/// Flagstones of uneven width in courses, continuing at the edges; colours and the height that goes with them.
Image pavingColors(std::string name, uint32_t size, Hex stone, Hex otherStone, Hex joint);
Image pavingNormals(std::string name, uint32_t size, float metres);

/// Streaked stone, continuing at the edges.
Image rockColors(std::string name, uint32_t size, Hex dark, Hex light);
Image rockNormals(std::string name, uint32_t size, float metres);

/// A panel pierced by round holes and four-pointed stars: alpha 0 in the holes.
Image piercedPanel(std::string name, uint32_t size, int repeats, Hex color);

}  // namespace reflet::builtin
