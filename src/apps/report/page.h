// What a report says, as plain values, and the page, the table and the JSON that say it. Knows no device and no file:
// pictures are names of PNG files that lie beside the page.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// How far a picture is from another one; see compare/compare.h.
struct ReportError {
    double relativeMse = 0.0;
    double flip = 0.0;  ///< mean, 0 equal to 1
    double psnr = 0.0;  ///< dB, infinite for equal pictures
};

struct ReportPass {
    std::string name;
    double ms = 0.0;
};

struct ReportVariant {
    std::string name;
    std::string settings;  ///< as --set takes them, what differs from the defaults; empty: nothing
    std::string picture;
    std::string truthErrorMap;    ///< FLIP against the truth
    std::string visibleErrorMap;  ///< FLIP against visible-only
    ReportError againstTruth;
    ReportError againstVisible;
    double frameMs = 0.0;
    std::vector<ReportPass> passes;  ///< in the order in which they ran
};

/// A path-traced picture.
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
    std::string visibleErrorMap;  ///< FLIP of visible-only against the truth
    ReportError visibleError;     ///< of visible-only against the truth
    std::vector<ReportVariant> variants;
};

struct ReportPage {
    std::string version;  ///< of the program
    std::string command;  ///< the command line that makes this report
    std::string device;
    uvec2 size{0};
    uint32_t seed = 0;
    uint32_t frames = 0;              ///< rendered for each variant
    std::optional<uint32_t> bounces;  ///< of the truth; none: without end
    std::string errorScale;           ///< a picture: colours of the error maps, 0 at the left to 1 at the right
    std::string plotSvg;              ///< inline SVG: error against time over all variants; empty: no plot
    std::vector<ReportScene> scenes;  ///< all with the same names of variants
};

/// The whole page. It refers to the pictures by name and to nothing else.
std::string reportHtml(const ReportPage& page);

/// All numbers. Infinite ones (PSNR of equal pictures) are null.
std::string reportJson(const ReportPage& page);

/// A table for a document: a row for each scene and variant, for visible-only, and for the noise of the truth.
std::string reportMarkdown(const ReportPage& page);

}  // namespace reflet
