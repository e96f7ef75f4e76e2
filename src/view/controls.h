// The controls of the panels, and their positions on the screen.
#pragma once

#include "renderer/settings.h"
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

/// Positions of the controls drawn in the last frame, in window units: for tests and scripts that use the window.
class ControlPlaces {
public:
    void clear() { places_.clear(); }
    /// Records the last drawn item under this name, if its centre is visible.
    void note(const std::string& name);
    [[nodiscard]] const std::map<std::string, Rectangle>& all() const { return places_; }

private:
    std::map<std::string, Rectangle> places_;
};

/// Formats the values with four digits.
std::string valuesText(const std::vector<float>& values);

/// Shows the text while the pointer hovers over the last item.
void tooltip(const std::string& text);

/// A combo box of names. Returns whether the choice changed.
bool chooseName(const char* label, const std::vector<std::string>& names, std::string& chosen);

/// One control for each setting whose name contains `filter`, in collapsible sections; settings that differ from
/// `standard` are marked and can be reset to it.
void settingControls(Settings& settings, const Settings& standard, const std::string& filter, ControlPlaces& places);

/// A control to drag a direction on a hemisphere seen from above: the centre is straight up. Returns whether it
/// changed. light: direction of travel of the light, unit length.
bool dragDirection(const char* name, vec3& light);

}  // namespace reflet
