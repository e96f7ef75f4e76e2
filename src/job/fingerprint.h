// Hashes data to a short text that identifies it.
#pragma once

#include "reference/reference.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct XXH3_state_s;

namespace reflet {

/// 64-bit XXH3, by Y. Collet. Not cryptographic: it only has to detect changes.
class Fingerprint {
public:
    Fingerprint();
    void add(std::span<const std::byte> bytes);
    void add(std::string_view text);
    /// 16 hexadecimal digits.
    [[nodiscard]] std::string text() const;

private:
    struct Free {
        void operator()(XXH3_state_s* state) const;
    };

    std::unique_ptr<XXH3_state_s, Free> state_;
};

/// Incremented whenever the data hashed below, or the hashing, changes: invalidates stored results of older versions.
constexpr uint32_t fingerprintVersion = 3;

/// Adds everything that an image of the scene can depend on, also names and cameras.
void addTo(Fingerprint& print, const Scene& scene);
/// Adds everything but probes and mirrors (planar reflections), which the path traced reference does not use.
void addTo(Fingerprint& print, const View& view);
/// Adds everything but the number of threads, on which the image does not depend.
void addTo(Fingerprint& print, const ReferenceOptions& options);

}  // namespace reflet
