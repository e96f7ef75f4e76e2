// Checks the headers of an EXR file before OpenEXR reads it.
#pragma once

#include <string_view>

namespace reflet {

/// Whether all lengths in the headers agree with the file and with each other. OpenEXR takes the memory that an
/// attribute claims, up to 2 GiB, before it reads it.
bool exrHeadersAreWhole(std::string_view file);

}  // namespace reflet
