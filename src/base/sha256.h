// SHA-256 (NIST, FIPS 180-4, Secure Hash Standard, 2015).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace reflet {

std::array<uint8_t, 32> sha256(std::string_view bytes);

/// In base64 (RFC 4648), as pages name scripts that they allow: 44 characters.
std::string sha256Base64(std::string_view bytes);

}  // namespace reflet
