// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/web_files.hpp"

#include <array>
#include <view/page_files.hpp>  // made by lio_embed_text

namespace lio {
namespace {

constexpr std::string_view kHtml = "text/html; charset=utf-8";
constexpr std::string_view kCss = "text/css; charset=utf-8";
constexpr std::string_view kScript = "text/javascript; charset=utf-8";
constexpr std::string_view kText = "text/plain; charset=utf-8";

struct Entry {
  std::string_view path;
  WebFile file;
};

constexpr auto kFiles = std::to_array<Entry>({
    {"/", {kHtml, kViewHtml}},
    {"/view.css", {kCss, kViewCss}},
    {"/main.js", {kScript, kViewMainJs}},
    {"/link.js", {kScript, kViewLinkJs}},
    {"/frames.js", {kScript, kViewFramesJs}},
    {"/stage.js", {kScript, kViewStageJs}},
    {"/cloud.js", {kScript, kViewCloudJs}},
    {"/splats.js", {kScript, kViewSplatsJs}},
    {"/track.js", {kScript, kViewTrackJs}},
    {"/panel.js", {kScript, kViewPanelJs}},
    {"/plots.js", {kScript, kViewPlotsJs}},
    {"/timeline.js", {kScript, kViewTimelineJs}},
    {"/three.js", {kScript, kViewThreeJs}},
    {"/uplot.js", {kScript, kViewPlotJs}},
    {"/uplot.css", {kCss, kViewPlotCss}},
    {"/licence/three.txt", {kText, kViewThreeLicence}},
    {"/licence/uplot.txt", {kText, kViewPlotLicence}},
});

}  // namespace

std::optional<WebFile> FindWebFile(std::string_view path) {
  for (const Entry& entry : kFiles) {
    if (entry.path == path) return entry.file;
  }
  return std::nullopt;
}

}  // namespace lio
