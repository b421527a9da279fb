#include "apps/reports/compare_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "apps/reports/csv.h"
#include "apps/system/terminal.h"

namespace apps {
namespace {

std::string family_of(const MethodVerdict& method) {
  return method.name.substr(0, method.name.find(':'));
}

std::string member_of(const MethodVerdict& method) {
  return method.name.substr(method.name.find(':') + 1);
}

/// Methods that have no more than three numbers for light.
bool has_three_numbers(const MethodVerdict& method) {
  const std::string family = family_of(method);
  return family == "rgb" || family == "bilinear" || family == "display";
}

/// Methods without an answer come last.
bool better(const MethodVerdict* p, const MethodVerdict* q) {
  if (p->colours.converged != q->colours.converged) return p->colours.converged;
  return de00_of(*p).worst < de00_of(*q).worst;
}

std::vector<const MethodVerdict*> sorted(const Comparison& comparison, const auto& belongs) {
  std::vector<const MethodVerdict*> methods;
  for (const MethodVerdict& method : comparison.methods) {
    if (&method != &comparison.methods.front() && belongs(method)) methods.push_back(&method);
  }
  std::ranges::stable_sort(methods, better);
  return methods;
}

/// What a worst Delta E_00 means; about 1 is just noticeable.
std::string in_words(double de00) {
  if (de00 < 1) return "nobody could tell the difference";
  if (de00 < 2) return "the difference shows only side by side";
  if (de00 < 5) return "the difference is plain to see side by side";
  return "it is another colour";
}

std::string worst_of(const Comparison& comparison, const MethodVerdict& method) {
  const MeanAndWorst de00 = de00_of(method);
  return fmt::format("{:.2f} on {}", de00.worst, comparison.surfaces[de00.worst_surface]);
}

std::string answer(const Comparison& comparison) {
  const MethodVerdict& best = *sorted(comparison, has_three_numbers).front();
  if (!best.colours.converged) return "**No.** No method with three numbers found an answer.\n";
  const double worst = de00_of(best).worst;
  const char* verdict = worst < 1 ? "Yes, with the right method." : worst < 2 ? "Nearly." : "No.";
  return fmt::format(
      "**{}** The best of the methods with three numbers is {}: it misses by a Delta E00 of at "
      "most "
      "{}, so {}.\n",
      verdict, best.name, worst_of(comparison, best), in_words(worst));
}

struct Family {
  const char* key;
  const char* what;
};

constexpr std::array<Family, 5> kFamilies{
    {{"rgb", "Classical RGB, light times reflectance in each component"},
     {"bilinear", "The bilinear product, which lets components mix"},
     {"display", "Surfaces as matrices or factors made from their spectra"},
     {"reconstructed", "Spectra made up from the sRGB of each surface, under the true lights"},
     {"spectral", "Spectra in fewer bands"}}};

std::string remarks(const std::vector<const MethodVerdict*>& members) {
  std::string text;
  for (const MethodVerdict* method : members) {
    const MethodColours& colours = method->colours;
    if (!colours.converged) text += fmt::format(" {} found no answer.", member_of(*method));
    if (colours.negative_patches > 0) {
      text += fmt::format(" {} has less than no light on {} patches.", member_of(*method),
                          colours.negative_patches);
    }
    if (!colours.note.empty()) text += fmt::format(" {}: {}.", member_of(*method), colours.note);
  }
  return text;
}

std::string paragraph(const Comparison& comparison, const Family& family) {
  const auto members = sorted(
      comparison, [&](const MethodVerdict& method) { return family_of(method) == family.key; });
  const MethodVerdict &best = *members.front(), &last = *members.back();
  return fmt::format(
      "- **{}** ({}): best with {}, mean {:.2f}, worst {}: {}. Least good with {}, worst {}: "
      "{}.{}\n",
      family.key, family.what, member_of(best), de00_of(best).mean, worst_of(comparison, best),
      in_words(de00_of(best).worst), member_of(last), worst_of(comparison, last),
      in_words(de00_of(last).worst), remarks(members));
}

std::string run_times(const Comparison& comparison) {
  const double judge = comparison.methods.front().seconds;
  const MethodVerdict *fastest = &comparison.methods.front(), *slowest = fastest;
  for (const MethodVerdict& method : comparison.methods) {
    if (!method.colours.converged) continue;
    if (method.seconds < fastest->seconds) fastest = &method;
    if (method.seconds > slowest->seconds) slowest = &method;
  }
  return fmt::format(
      "The judge took {:.1f} ms, the fastest method ({}) {:.1f} ms, the slowest ({}) {:.1f} ms. "
      "What "
      "depends on geometry alone is computed once for all and not counted.\n",
      1e3 * judge, fastest->name, 1e3 * fastest->seconds, slowest->name, 1e3 * slowest->seconds);
}

std::string markdown_table(const Comparison& comparison) {
  std::string text =
      "| method | mean Delta E00 | worst | mean distance | worst | ms |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (const MethodVerdict& method : comparison.methods) {
    const MeanAndWorst de00 = de00_of(method), jab = distance_of(method);
    text += fmt::format(
        "| {} | {:.2f} | {} | {:.2f} | {:.2f} | {} |\n", method.name, de00.mean,
        de00.worst > 0 ? worst_of(comparison, method) : "0.00", jab.mean, jab.worst,
        method.colours.converged ? fmt::format("{:.1f}", 1e3 * method.seconds) : "no answer");
  }
  return text;
}

}  // namespace

std::string compare_csv(const Comparison& comparison) {
  CsvText csv("method,surface,X,Y,Z,J,a_C,b_C,distance,dE00,seconds,converged,status");
  for (const MethodVerdict& method : comparison.methods) {
    for (std::size_t k = 0; k < method.surfaces.size(); ++k) {
      const Verdict& v = method.surfaces[k];
      const auto& [xyz, correlates] = v.seen;
      const Reported r(correlates);
      csv.cell(method.name).cell(comparison.surfaces[k]).cell(xyz.x).cell(xyz.y).cell(xyz.z);
      csv.cell(r.j).cell(r.a_c).cell(r.b_c).cell(v.distance).cell(v.de00).cell(method.seconds);
      csv.cell(method.colours.converged ? "yes" : "no");
      csv.cell(appearance::to_string(correlates.status)).end_row();
    }
  }
  return csv.take();
}

std::string methods_csv(const Comparison& comparison) {
  CsvText csv(
      "method,what,mean_dE00,worst_dE00,worst_surface,mean_distance,worst_distance,seconds,"
      "converged,negative_patches,note");
  for (const MethodVerdict& method : comparison.methods) {
    const MeanAndWorst de00 = de00_of(method), jab = distance_of(method);
    csv.cell(method.name).cell(method.what).cell(de00.mean).cell(de00.worst);
    csv.cell(comparison.surfaces[de00.worst_surface]).cell(jab.mean).cell(jab.worst);
    csv.cell(method.seconds).cell(method.colours.converged ? "yes" : "no");
    csv.cell(method.colours.negative_patches).cell(method.colours.note).end_row();
  }
  return csv.take();
}

Json method_list(const Comparison& comparison) {
  Json list = Json::array();
  for (const MethodVerdict& method : comparison.methods) {
    const MeanAndWorst de00 = de00_of(method), jab = distance_of(method);
    list.push_back({{"method", method.name},
                    {"what", method.what},
                    {"mean_dE00", de00.mean},
                    {"worst_dE00", de00.worst},
                    {"worst_surface", comparison.surfaces[de00.worst_surface]},
                    {"mean_distance", jab.mean},
                    {"worst_distance", jab.worst},
                    {"seconds", method.seconds},
                    {"converged", method.colours.converged},
                    {"negative_patches", method.colours.negative_patches},
                    {"note", method.colours.note}});
  }
  return list;
}

std::string method_table(const Comparison& comparison) {
  std::vector<std::vector<std::string>> rows{
      {"method", "mean dE00", "worst dE00", "on", "mean distance", "worst", "ms"}};
  for (const MethodVerdict& method : comparison.methods) {
    const MeanAndWorst de00 = de00_of(method), jab = distance_of(method);
    rows.push_back(
        {method.name, fmt::format("{:.2f}", de00.mean), fmt::format("{:.2f}", de00.worst),
         comparison.surfaces[de00.worst_surface], fmt::format("{:.2f}", jab.mean),
         fmt::format("{:.2f}", jab.worst),
         method.colours.converged ? fmt::format("{:.1f}", 1e3 * method.seconds) : "not converged"});
  }
  return table("<>><>>>", rows);
}

std::string summary(const Comparison& comparison) {
  std::string text =
      fmt::format("# Are three numbers enough? {}\n\n{}\n", comparison.room, answer(comparison));
  text += fmt::format(
      "{} surfaces were computed by {} methods on the same {} patches. The judge is the solve with "
      "31 bands; one eye, adapted to its light, looks at all answers. A Delta E00 of about 1 is "
      "just "
      "noticeable side by side; distances are those in J, a_C, b_C by which paints are ranked.\n\n",
      comparison.surfaces.size(), comparison.methods.size(), comparison.patches);
  text += "## By kind of method\n\n";
  for (const Family& family : kFamilies) text += paragraph(comparison, family);
  text += "\n## Run time\n\n" + run_times(comparison);
  text += "\n## Numbers\n\n" + markdown_table(comparison);
  return text;
}

}  // namespace apps
