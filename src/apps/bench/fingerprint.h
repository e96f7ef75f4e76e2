// A short text that stands for much data: the same data gives the same text, other data another one.
#pragma once

#include "reference/reference.h"
#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace reflet {

/// FNV-1a of 64 bits, by G. Fowler, L. C. Noll, K.-P. Vo. It need only notice changes, not withstand anybody.
class Fingerprint {
public:
    void add(std::span<const std::byte> bytes);
    void add(std::string_view text);
    /// 16 hexadecimal digits.
    [[nodiscard]] std::string text() const;

private:
    uint64_t hash_ = 0xCBF29CE484222325ULL;
};

/// Of all that a picture of it can depend on; names and cameras, which only help to find things, included.
void addTo(Fingerprint& print, const Scene& scene);
/// Of all but probes and mirrors, which are the renderer's own affair: the truth has none.
void addTo(Fingerprint& print, const View& view);
/// Of all but the number of threads, on which the picture does not depend.
void addTo(Fingerprint& print, const ReferenceOptions& options);

}  // namespace reflet
