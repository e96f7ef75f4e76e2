// Checks a PNG image before stb_image decodes it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace reflet {

bool startsAsPng(std::span<const uint8_t> bytes);

/// What is wrong with the chunks, as the end of an error message; empty: nothing. stb_image takes the memory that a
/// chunk claims, up to 2 GiB, before it reads it.
std::string pngProblem(std::span<const uint8_t> bytes);

/// Whether a file of this size ends with the chunk that ends every PNG.
bool pngHasItsEnd(const std::filesystem::path& file, uint64_t size);

}  // namespace reflet
