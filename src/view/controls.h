// What panels are made of, and where it is on the screen.
#pragma once

#include "render/settings.h"
#include "scene/scene.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

struct Rectangle {
    vec2 min{0.0F};
    vec2 max{0.0F};
};

/// Where each control was drawn in the last frame, in the window's units: for scripts that use the window, and tests.
class ControlPlaces {
public:
    void clear() { places_.clear(); }
    /// The item that was drawn last goes by this name, if its middle can be seen.
    void note(const std::string& name);
    [[nodiscard]] const std::map<std::string, Rectangle>& all() const { return places_; }

private:
    std::map<std::string, Rectangle> places_;
};

/// Shows the text when the pointer rests on the last item.
void tooltip(const std::string& text);

/// A choice from names. True: another one was chosen.
bool chooseName(const char* label, const std::vector<std::string>& names, std::string& chosen);

/// One control for each setting of the table whose name has `filter` in it, in sections that open and close; `standard`
/// is what they are marked and reset by.
void settingControls(Settings& settings, const Settings& standard, const std::string& filter, ControlPlaces& places);

/// A direction to drag on a sphere that is seen from above: the middle is straight up. True: it has changed. light: the
/// way that it travels, unit.
bool dragDirection(const char* name, vec3& light);

}  // namespace reflet
