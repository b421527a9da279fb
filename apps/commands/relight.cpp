#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "appearance/spectra/relighting.h"
#include "appearance/spectra/text/input_error.h"
#include "apps/commands/commands.h"
#include "apps/pictures/exr_relighting.h"
#include "apps/run/run_record.h"
#include "apps/system/output_files.h"
#include "apps/system/terminal.h"

namespace apps {
namespace {

constexpr std::array<const char*, 3> kChannels{"R", "G", "B"};

Eigen::Matrix3d matrix_of(const RelightCommand& command) {
  const Eigen::Vector3d from(command.from.data()), to(command.to.data());
  try {
    return command.classical
               ? spectra::classical_relighting_matrix(from, to)
               : spectra::relighting_matrix(spectra::bilinear_set(command.set), from, to);
  } catch (const std::domain_error& error) {
    throw spectra::InputError({{.file = "--from",
                                .problem = error.what(),
                                .remedy = "give a light nearer to white, or another --set"}});
  }
}

/// Of all pixels whose components are finite.
double share_of(std::int64_t count, const PixelStatistics& s) {
  const std::int64_t finite = s.pixels - s.not_finite;
  return finite > 0 ? static_cast<double>(count) / static_cast<double>(finite) : 0;
}

double mean_of(const ChannelStatistics& channel, const PixelStatistics& s) {
  return channel.sum / static_cast<double>(s.pixels - s.not_finite);  // NaN if there are none
}

Json to_json(const ChannelStatistics& channel, const PixelStatistics& s) {
  return {{"min", channel.lowest},
          {"mean", mean_of(channel, s)},
          {"max", channel.highest},
          {"negative", channel.negative},
          {"negative_share", share_of(channel.negative, s)}};
}

Json to_json(const ExrReport& report) {
  const PixelStatistics& s = report.statistics;
  Json channels = Json::array(), parts = Json::array();
  for (std::size_t c = 0; c < 3; ++c) {
    channels.push_back({{"name", kChannels[c]},
                        {"before", to_json(s.before[c], s)},
                        {"after", to_json(s.after[c], s)}});
  }
  for (const ExrPart& part : report.parts) {
    parts.push_back({{"name", part.name},
                     {"width", part.width},
                     {"height", part.height},
                     {"relit", part.relit}});
  }
  return {{"parts", parts},
          {"pixels", s.pixels},
          {"not_finite", s.not_finite},
          {"overflowed", s.overflowed},
          {"negative", {{"pixels", s.negative}, {"share", share_of(s.negative, s)}}},
          {"channels", channels}};
}

std::string to_text(const PixelStatistics& s) {
  std::vector<std::vector<std::string>> rows{
      {"", "min", "mean", "max", "relit min", "mean", "max", "negative"}};
  for (std::size_t c = 0; c < 3; ++c) {
    const ChannelStatistics &before = s.before[c], &after = s.after[c];
    rows.push_back(
        {kChannels[c], fmt::format("{:.4g}", before.lowest),
         fmt::format("{:.4g}", mean_of(before, s)), fmt::format("{:.4g}", before.highest),
         fmt::format("{:.4g}", after.lowest), fmt::format("{:.4g}", mean_of(after, s)),
         fmt::format("{:.4g}", after.highest),
         fmt::format("{} ({:.3g} %)", after.negative, 100 * share_of(after.negative, s))});
  }
  std::string text = table("<>>>>>>>", rows);
  text += fmt::format("{} pixels, {} of them with a negative component ({:.3g} %)\n", s.pixels,
                      s.negative, 100 * share_of(s.negative, s));
  if (s.not_finite > 0) {
    text +=
        fmt::format("{} pixels are no finite numbers and were left as they are\n", s.not_finite);
  }
  if (s.overflowed > 0) {
    text +=
        fmt::format("{} pixels are too bright for the file's pixel type: infinite\n", s.overflowed);
  }
  return text;
}

}  // namespace

Exit relight_picture(const RelightCommand& command, const Session& session) {
  const Eigen::Matrix3d matrix = matrix_of(command);
  if (!matrix.cast<float>().allFinite()) {
    throw spectra::InputError({{.file = "--from, --to",
                                .problem = "the change of light is beyond all floats",
                                .remedy = "give lights of like size"}});
  }
  ExrReport report;
  write_file(command.out, [&](const std::filesystem::path& temporary) {
    report = relight_exr(command.in, temporary, matrix, thread_count(session));
  });
  for (const ExrPart& part : report.parts) {
    if (!part.relit) report_notes({fmt::format("part {} is copied as it is", part.name)});
  }
  tell("wrote {}\n", command.out);
  if (session.json) {
    Json data = to_json(report);
    data["file"] = command.out;
    data["product"] = command.classical ? "classical" : command.set;
    data["matrix"] = Json::array();
    for (int row = 0; row < 3; ++row) {
      data["matrix"].push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2)});
    }
    put(data.dump(2) + "\n");
  } else {
    put(to_text(report.statistics));
  }
  return Exit::done;
}

}  // namespace apps
