// Contact sheets: many pictures in one image, in a grid, with their names.
#pragma once

#include "base/image_file.h"
#include "base/math.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace reflet {

struct SheetPicture {
    std::string name;
    Bitmap bitmap;  ///< RGB or RGBA, sRGB-encoded, no larger than the cell: see fitted
};

struct SheetOptions {
    uvec2 cell{320, 240};  ///< pixels for each picture, without its name
    uint32_t columns = 0;  ///< 0: as many as make the sheet about 16:9
    uint32_t gap = 12;     ///< pixels between pictures and around them
    uint8_t grey = 32;     ///< background value, also behind transparent pictures
};

/// RGB or RGBA, scaled down to fit within `most` by a box filter in linear light; smaller bitmaps are unchanged.
Bitmap fitted(const Bitmap& bitmap, uvec2 most);

/// Number of columns of a sheet of `count` pictures.
uint32_t sheetColumns(const SheetOptions& options, size_t count);

/// Row by row, each picture in the middle of its cell and its name below, shortened to the cell's width. Names are left
/// out where no font is installed. Throws UsageError for a sheet of more than 16384 pixels a side.
Bitmap contactSheet(std::span<const SheetPicture> pictures, const SheetOptions& options);

}  // namespace reflet
