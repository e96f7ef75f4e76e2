// What the pixel panel says.
#include "view/panel_text.h"
#include "view/pixel_inspector.h"

#include <imgui.h>

#include <algorithm>

namespace reflet {

namespace {

// Rays that hit nothing have a distance of 0.
std::string pickedText(const PickedValues& picked) {
    if (!picked.name.ends_with("hit_distance")) {
        return valuesText(picked.values);
    }
    std::string all;
    for (const float value : picked.values) {
        all += fmt::format("{}{}", all.empty() ? "" : "  ", value > 0.0F ? fmt::format("{:.4g}", value) : "miss");
    }
    return all;
}

// The sources that are on, in the order in which a ray that misses the screen asks them.
std::string nextSources(const Settings& settings) {
    std::vector<std::string> names;
    if (settings.planar.enabled != 0 && settings.planar.beforeScreen == 0) {
        names.emplace_back("planar reflections");
    }
    if (settings.traceScene.enabled != 0) {
        names.emplace_back("ray tracing (trace_scene)");
    }
    if (settings.probes.enabled != 0) {
        names.emplace_back("probes");
    }
    if (settings.environment.enabled != 0) {
        names.emplace_back("the environment");
    }
    return fmt::format("{}", fmt::join(names, ", then "));
}

// Explains the outcome of the mirror ray.
std::string explanation(const RecordedRay& ray, const Settings& all) {
    const TraceScreenSettings& settings = all.traceScreen;
    const std::string at = fmt::format("pixel {}, {}", ray.pixel.x, ray.pixel.y);
    std::string why;
    if (countsAsHit(ray, settings)) {
        why = fmt::format(
            "Hit: after {:.3g} m it meets the surface at {}. Confidence {:.2f}: edge {:.2f}, distance {:.2f}, "
            "camera {:.2f}.",
            ray.distance, at, ray.confidence, ray.edge, ray.far, ray.camera);
    } else if (ray.outcome == RayOutcome::hit) {
        why = fmt::format(
            "Miss: after {:.3g} m it meets the surface at {} from behind or from a side that the screen does not show, "
            "or it passed behind something before (trace_screen.reject_backfaces).",
            ray.distance, at);
    } else if (ray.outcome == RayOutcome::leftScreen) {
        why = fmt::format("Miss: it leaves the screen after {:.3g} m.", ray.distance);
    } else if (ray.outcome == RayOutcome::hidden) {
        why = fmt::format("Miss: it passes behind a surface by more than trace_screen.thickness ({:g} m).",
                          settings.thickness);
    } else {
        why = fmt::format("Miss: it has reached trace_screen.max_steps ({}) or trace_screen.max_distance ({:g} m).",
                          settings.maxSteps, settings.maxDistance);
    }
    if (ray.lost && !countsAsHit(ray, settings)) {
        why += fmt::format(
            " From {:.3g} m on it was occluded: behind a visible surface by more than trace_screen.thickness "
            "({:g} m).",
            ray.clear, settings.thickness);
    }
    if (!countsAsHit(ray, settings)) {
        const std::string next = nextSources(all);
        why += next.empty() ? " Nothing else is on: its light is black." : fmt::format(" Next: {}.", next);
    }
    return why;
}

}  // namespace

// Sources that are off and could answer a miss.
void PixelInspector::offerSources() {
    if (countsAsHit(*picked_->ray, work_.state.settings.traceScreen)) {
        return;
    }
    Settings& s = work_.state.settings;
    bool first = true;
    for (const auto& [name, on] :
         {std::pair("ray tracing", &s.traceScene.enabled), std::pair("probes", &s.probes.enabled),
          std::pair("environment", &s.environment.enabled)}) {
        if (*on != 0) {
            continue;
        }
        if (!first) {
            ImGui::SameLine();
        }
        first = false;
        if (ImGui::Button(fmt::format("switch on {}", name).c_str())) {
            *on = 1;
        }
        work_.places.note(fmt::format("switch on {}", name));
    }
}

// What is drawn over the picture.
void PixelInspector::explainPanel() {
    const auto choice = [&](const char* name, Explains what, const std::string& help) {
        if (ImGui::RadioButton(name, explains_ == what)) {
            explains_ = what;
        }
        work_.places.note(name);
        tooltip(help);
    };
    choice("mirror ray", Explains::mirror, "The march of the mirror ray: its depth samples, and where it hits.");
    ImGui::SameLine();
    choice("diffuse rays", Explains::diffuse,
           fmt::format(
               "{} rays over the pixel's hemisphere, each for the same share of its diffuse light, coloured by who "
               "answers: green the screen, else the first source that is on: yellow ray tracing, magenta probes, "
               "blue the environment.",
               recordedSamples));
    ImGui::SameLine();
    choice(
        "shadow", Explains::shadow,
        "The look-ups in the sun's shadow map, of the blocker search and the filter: red where something blocks, drawn "
        "there; green where not.");
    if (explains_ == Explains::diffuse) {
        const auto hits = std::ranges::count_if(picked_->hemisphere, &RecordedSample::hits);
        ImGui::Text("%d of %u hit the screen", static_cast<int>(hits), recordedSamples);
    } else if (explains_ == Explains::shadow) {
        explainShadow();
    }
}

void PixelInspector::explainShadow() const {
    if (!picked_->shadow) {
        wrappedText("No shadow map: the sun or its shadows are off, or shadows are ray-traced.");
        return;
    }
    const RecordedShadow& shadow = *picked_->shadow;
    const auto blocking = std::ranges::count_if(shadow.texels, &RecordedShadow::Texel::blocks);
    wrappedText(
        fmt::format("{} look-ups, {} blocked; visibility {:.2f}; mean blocker {:.3g} m toward the sun; penumbra "
                    "{:.3g} m wide",
                    shadow.lookups, blocking, shadow.visibility, std::max(shadow.blockerHeight, 0.0F),
                    std::max(shadow.penumbraWidth, 0.0F)));
}

// What is picked, and what can be done with it.
void PixelInspector::headPanel() {
    ImGui::Text("pixel %u, %u", picked_->pixel.x, picked_->pixel.y);
    ImGui::SameLine();
    if (ImGui::Button("again")) {
        pick(glm::min(picked_->pixel, work_.renderSize() - 1U), false);
    }
    work_.places.note("pick again");
    tooltip(
        "Picks this pixel again in the current image. Changes of settings and light do so automatically; a moved "
        "camera shows the recorded ray from its new position.");
    ImGui::SameLine();
    if (ImGui::Button("focus here")) {
        work_.attempt([&] { focusOnPicked(); });
    }
    work_.places.note("focus here");
    tooltip("Puts the plane of focus of the camera's lens at this pixel's depth.");
}

void PixelInspector::drawPanel() {
    if (!picked_) {
        ImGui::TextDisabled("Click on the image to pick a pixel.");
        return;
    }
    headPanel();
    if (picked_->ray) {
        ImGui::PushTextWrapPos(0.0F);
        ImGui::Text("Mirror ray, %u depth samples", picked_->ray->samples);
        ImGui::TextUnformatted(explanation(*picked_->ray, work_.state.settings).c_str());
        ImGui::PopTextWrapPos();
        offerSources();
        explainPanel();
    } else {
        ImGui::TextUnformatted("No surface here.");
    }
    if (ImGui::BeginTable("values", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
        for (const PickedValues& values : picked_->values) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(values.name.c_str());
            tooltip(std::string(findShow(values.name).description));
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(pickedText(values).c_str());
        }
        ImGui::EndTable();
    }
}

}  // namespace reflet
