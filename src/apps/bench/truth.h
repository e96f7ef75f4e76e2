// What measured pictures are held against: path traced, or the same settings with very many rays. Made once and kept as
// EXR files in a folder, under names that depend on everything that the picture depends on.
#pragma once

#include "apps/bench/subject.h"
#include "reference/reference.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

enum class TruthKind : uint8_t {
    none,
    reference,  ///< of the path tracer
    chain,      ///< what the settings themselves tend to: the mean of so many rays a pixel, with nothing that cleans
};

struct TruthOptions {
    TruthKind kind = TruthKind::reference;
    ReferenceOptions reference;       ///< lambertOnly is taken from the settings
    uint32_t chainRays = 1024;        ///< of each lobe, per pixel
    std::optional<Settings> chainOf;  ///< of which `chain` is in the place of those that are measured
    std::filesystem::path folder;
};

/// "reference", "none", "chain:1024". Throws UsageError.
void parseTruth(const std::string& text, TruthOptions& options);

/// $XDG_CACHE_HOME/reflet/truth, or ~/.cache/reflet/truth.
std::filesystem::path standardTruthFolder();

/// All that the truth of this scene at this size depends on, as text on one line. For `chain` also all settings and
/// this program itself.
std::string truthKey(const BenchScene& scene, uvec2 size, const Settings& settings, const TruthOptions& options);

struct Truth {
    Layers layers;         ///< final, direct, indirect_diffuse, indirect_specular; none for TruthKind::none
    std::string file;      ///< where it is kept
    uint32_t samples = 0;  ///< per pixel, or rays
    double noise = 0.0;    ///< of ReferencePicture; 0 for a chain
};

/// From the folder, or made now and put there. Shows progress. Throws Error.
Truth getTruth(gpu::Device& device, const BenchScene& scene, uvec2 size, const Settings& settings,
               const TruthOptions& options);

/// The settings with so many rays a frame, their mean over frames, at full size, and nothing that cleans: what `chain`
/// renders.
Settings chainSettings(const Settings& settings, uint32_t raysPerFrame);

}  // namespace reflet
