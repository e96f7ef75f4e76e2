// Images of the built-in scenes: labelled tiles to check reflections by, paving, rock, a perforated panel.
#pragma once

#include "scene/builtin/canvas.h"

#include <span>

namespace reflet::builtin {

/// Square of tiles, columns A, B, ... and rows 1, 2, ... from the top, each labelled: "C4".
struct LabelledTiles {
    uint32_t size = 1024;  ///< pixels per side
    int tiles = 8;         ///< per side
    std::span<const Hex> colors;
    Hex joint = 0x2A2A2E;
    Hex letters = 0xF4EFE6;
    float grain = 4.0F;
    uint32_t seed = 1;  ///< of the tiles' colours
};
TextureImage labelledTiles(std::string name, const LabelledTiles& style);

/// A square emblem of rings, a frame and a label that looks different when rotated or mirrored.
TextureImage emblem(std::string name, std::string_view label, Hex field, Hex frame, Hex mark);

/// Tileable flagstones of uneven width in courses: colours, and the matching normals.
TextureImage pavingColors(std::string name, uint32_t size, Hex stone, Hex otherStone, Hex joint);
TextureImage pavingNormals(std::string name, uint32_t size, float metres);

/// Tileable streaked stone.
TextureImage rockColors(std::string name, uint32_t size, Hex dark, Hex light);
TextureImage rockNormals(std::string name, uint32_t size, float metres);

/// A panel perforated by round holes and four-pointed stars: alpha 0 in the holes.
TextureImage piercedPanel(std::string name, uint32_t size, int repeats, Hex color);

}  // namespace reflet::builtin
