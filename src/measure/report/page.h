// The content of a report as plain values, and its output as page, table and JSON. Independent of devices and files:
// images are names of PNG files beside the page.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// The error of one image against another; see compare/compare.h.
struct ReportError {
    double relativeMse = 0.0;
    double flip = 0.0;  ///< mean, 0 (equal) to 1
    double psnr = 0.0;  ///< dB, infinite for equal images
    double bias = 0.0;  ///< mean of the variant / mean of the reference - 1: above 0 too bright
};

struct ReportPass {
    std::string name;
    double ms = 0.0;
};

struct ReportVariant {
    std::string name;
    std::string settings;  ///< settings that differ from the defaults, in the form of --set
    std::string picture;
    std::string truthErrorMap;    ///< FLIP against the ground truth
    std::string visibleErrorMap;  ///< FLIP against visible-only
    ReportError againstTruth;
    ReportError againstVisible;
    double frameMs = 0.0;
    std::vector<ReportPass> passes;  ///< in the order in which they ran
};

/// A path-traced image.
struct ReportReference {
    std::string picture;
    uint32_t samples = 0;  ///< per pixel
    double noise = 0.0;    ///< its square is the relative MSE of one run against the mean of all
};

struct ReportScene {
    std::string name;
    std::string source;       ///< as given on the command line
    std::string description;  ///< one line
    ReportReference truth;
    ReportReference visible;
    std::string visibleErrorMap;    ///< FLIP of visible-only against the ground truth
    ReportError visibleError;       ///< of visible-only against the ground truth
    std::optional<float> exposure;  ///< stops, metered from the ground truth; none without automatic exposure
    std::vector<ReportVariant> variants;
};

struct ReportPage {
    std::string version;  ///< program version
    std::string command;  ///< the command line that makes this report
    std::string device;
    uvec2 size{0};
    uint32_t seed = 0;
    uint32_t frames = 0;              ///< frames rendered for each variant
    std::optional<uint32_t> bounces;  ///< bounces of the ground truth; none: unlimited
    std::string errorScale;  ///< image file: colour bar of the error maps, from 0 at the left to 1 at the right
    std::string plotSvg;     ///< inline SVG: error against time over all variants; empty: no plot
    std::vector<ReportScene> scenes;  ///< all with the same names of variants
};

/// The whole page. It refers to the image files by name and to nothing else.
std::string reportHtml(const ReportPage& page);

/// All numbers as JSON. Infinite ones (PSNR of equal images) are null.
std::string reportJson(const ReportPage& page);

/// A table for a document: rows for each scene and variant, for visible-only, and for the noise of the references.
std::string reportMarkdown(const ReportPage& page);

}  // namespace reflet
