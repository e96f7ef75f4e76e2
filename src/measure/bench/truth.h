// The ground truth for measured images: path traced, or the same settings with very many rays. Rendered once and cached
// as EXR files in a folder; file names contain a hash of all inputs of the image.
#pragma once

#include "measure/bench/subject.h"
#include "reference/reference.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

enum class TruthKind : uint8_t {
    none,
    reference,  ///< path traced
    chain,      ///< the converged result of the settings: mean of chainRays rays per pixel, without denoising
};

struct TruthOptions {
    TruthKind kind = TruthKind::reference;
    ReferenceOptions reference;       ///< lambertOnly comes from the settings
    uint32_t chainRays = 1024;        ///< per lobe and pixel
    std::optional<Settings> chainOf;  ///< settings for `chain`, instead of those that are measured
    std::filesystem::path folder;
};

/// "reference", "none", "chain:1024". Throws UsageError.
void parseTruth(const std::string& text, TruthOptions& options);

/// $XDG_CACHE_HOME/reflet/truth, or ~/.cache/reflet/truth.
std::filesystem::path standardTruthFolder();

/// All inputs of the ground truth of this scene at this size, as one line of text. For `chain` that includes all
/// settings and this program itself.
std::string truthKey(const BenchScene& scene, uvec2 size, const Settings& settings, const TruthOptions& options);

struct Truth {
    Layers layers;         ///< final, direct, indirect_diffuse, indirect_specular; empty for TruthKind::none
    std::string file;      ///< its cache file
    uint32_t samples = 0;  ///< samples per pixel; for a chain, rays per pixel
    double noise = 0.0;    ///< as in ReferencePicture; 0 for a chain
};

/// Loads it from the folder, or renders it and stores it there. Shows progress. Throws Error.
Truth getTruth(gpu::Device& device, const BenchScene& scene, uvec2 size, const Settings& settings,
               const TruthOptions& options);

/// The settings that `chain` renders: `raysPerFrame` rays, accumulated over frames, at full resolution, without
/// denoising.
Settings chainSettings(const Settings& settings, uint32_t raysPerFrame);

}  // namespace reflet
