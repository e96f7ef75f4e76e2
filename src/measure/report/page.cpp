// Writes the report's page: one HTML file with embedded style and script.
#include "measure/report/page.h"

#include "base/embedded.h"
#include "base/error.h"
#include "base/sha256.h"
#include "measure/report/page_scene.h"
#include "measure/report/text.h"
#include "measure/report/xml_text.h"

#include <algorithm>
#include <iterator>
#include <span>

namespace reflet {

std::span<const EmbeddedFile> reportFiles();

namespace {

std::string_view reportFile(std::string_view name) {
    const auto found = std::ranges::find(reportFiles(), name, &EmbeddedFile::name);
    REFLET_CHECK(found != reportFiles().end(), "{} is not embedded", name);
    return found->text;
}

// The order matters: later rules override earlier ones.
std::string style() {
    std::string all;
    for (const std::string_view name : {"page.css", "tables.css", "pictures.css", "print.css"}) {
        all += reportFile(name);
    }
    return all;
}

std::string sceneId(size_t index) {
    return fmt::format("scene-{}", index + 1);
}

std::string navigation(const ReportPage& page) {
    if (page.scenes.size() < 2) {
        return "";
    }
    std::string html = "<nav aria-label=\"Scenes\"><ul>";
    for (size_t i = 0; i < page.scenes.size(); ++i) {
        html += fmt::format("<li><a href=\"#{}\">{}</a></li>", sceneId(i), xmlText(page.scenes[i].name));
    }
    return html + "</ul></nav>\n";
}

std::string header(const ReportPage& page) {
    const size_t variants = page.scenes.empty() ? 0 : page.scenes.front().variants.size();
    return fmt::format(
        R"(<header>
<h1>Reflet report</h1>
<p class="lead">{} of {} compared with a path-traced ground truth: error and time.</p>
<dl class="facts">
<div><dt>device</dt><dd>{}</dd></div>
<div><dt>size</dt><dd>{} × {}</dd></div>
<div><dt>frames per variant</dt><dd>{}</dd></div>
<div><dt>seed</dt><dd>{}</dd></div>
<div><dt>ground truth</dt><dd>{}</dd></div>
<div><dt>program</dt><dd>reflet {}</dd></div>
</dl>
{}</header>
)",
        countText(variants, "variant"), countText(page.scenes.size(), "scene"), xmlText(page.device), page.size.x,
        page.size.y, page.frames, page.seed, bouncesText(page.bounces), xmlText(page.version), navigation(page));
}

std::string plot(const ReportPage& page) {
    if (page.plotSvg.empty()) {
        return "";
    }
    return fmt::format(
        R"(<section class="plot">
<h2>Error against time</h2>
<div class="scroll" role="region" aria-label="Error against time" tabindex="0">
{}
</div>
</section>
)",
        page.plotSvg);
}

std::string reproduce(const ReportPage& page) {
    return fmt::format(
        R"(<section>
<h2>Reproduce this report</h2>
<div class="scroll" role="region" aria-label="Command line" tabindex="0"><pre><code>{}</code></pre></div>
<p>The same command on the same device gives the same images and errors; times vary.
All numbers: <a href="report.json">report.json</a>, <a href="table.md">table.md</a>.</p>
</section>
)",
        xmlText(page.command));
}

// Explains the terms of the tables.
constexpr const char* howToRead = R"(<section class="reading">
<h2>How to read this report</h2>
<dl>
<dt>ground truth</dt>
<dd>The scene path traced on the CPU: all light paths, filtered over the area of each pixel.</dd>
<dt>visible-only</dt>
<dd>The same path tracer, but scattered rays return light only from points that the camera sees and from the
environment: the best that a screen-space method can reach without guessing. A variant's error against the ground truth
has two causes: off-screen and occluded surfaces (visible-only against the ground truth), and the error of the method
itself (the variant against visible-only). The two need not add up, as a fallback may guess right.</dd>
<dt>relative MSE</dt>
<dd>Mean of (image − reference)² / (reference² + 0.01) over pixels and channels of linear radiance. 0: equal.</dd>
<dt>FLIP</dt>
<dd>The difference that a person perceives when flipping between the two images, from 0 (none) to 1. The error maps
show it per pixel, in these colours:
<span class="scale">0 <img src="@scale@" alt="Colours of the error maps, from black for 0 through violet, red and
orange to pale yellow for 1" width="256" height="12"> 1</span></dd>
<dt>PSNR</dt>
<dd>Peak signal-to-noise ratio: the reference's brightest value over the root mean squared error, in decibels. Higher
is better.</dd>
<dt>reference noise</dt>
<dd>Relative MSE that a second run of the reference would have. Smaller differences are not significant.</dd>
<dt>milliseconds</dt>
<dd>Device time, the median over the frames after the first. Bars show a pass's share of the frame.</dd>
</dl>
</section>
)";

std::string reading(const ReportPage& page) {
    constexpr std::string_view place = "@scale@";
    std::string html = howToRead;
    return html.replace(html.find(place), place.size(), xmlText(page.errorScale));
}

std::string pageTitle(const ReportPage& page) {
    std::vector<std::string> names;
    std::ranges::transform(page.scenes, std::back_inserter(names), [](const ReportScene& s) { return s.name; });
    return xmlText(fmt::format("Reflet report: {}", fmt::join(names, ", ")));
}

}  // namespace

namespace {

// What the page may do: run its own script, and show images beside it. Nothing that a name or a text could bring in.
std::string contentPolicy(std::string_view script) {
    return fmt::format(
        "default-src 'none'; script-src 'sha256-{}'; style-src 'unsafe-inline'; img-src 'self' file: data:; "
        "base-uri 'none'; form-action 'none'",
        sha256Base64(script));
}

}  // namespace

std::string reportHtml(const ReportPage& page) {
    const std::string script = fmt::format("\n{}", reportFile("page.js"));
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n<link rel=\"icon\" href=\"data:,\">\n"
        "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<main>\n",
        contentPolicy(script), pageTitle(page), style());
    html += header(page) + "<div class=\"overview\">\n" + plot(page) + reading(page) + "</div>\n";
    for (size_t i = 0; i < page.scenes.size(); ++i) {
        html += sceneSection(page.scenes[i], page.size, sceneId(i));
    }
    html += reproduce(page);
    html += fmt::format("</main>\n<script>{}</script>\n</body>\n</html>\n", script);
    return html;
}

}  // namespace reflet
