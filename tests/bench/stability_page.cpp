// Runs the stiff and extreme cases and writes the page about them:
//   build/release/tests/bench/stability_page solver/stability.md
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "tests/support/stability_cases.h"

namespace {

constexpr const char* kHead =
    R"(# Numerical stability

Stiff and extreme cases, run through the engine and compared with truths that do not come from it. Written by
`build/release/tests/bench/stability_page solver/stability.md`; `tests/solver/stability_test.cpp` runs the same cases
(`tests/support/stability_cases.h`) and fails where an error exceeds its limit.

)";

constexpr const char* kIterationsHead = R"(## Reflectances near 1

Everything reflects rho, a panel in one corner shines. Iterations of conjugate gradients to a proven relative error of 1e-8, with the
coarse room and, in brackets, without. Each is a product with the exchange matrix in float; 2 to 5 products in double prove the
result. The error is the largest of three at any rho: mean light against flux / (A (1 - rho)), radiosity against a direct solve, white furnace
with reflectances from 0 to 0.9999.

)";

std::string iterations_table() {
  std::string table = kIterationsHead;
  table += "| Room | patches |";
  for (const double rho : stability::kReflectances) table += fmt::format(" {} |", rho);
  table += " limit | error |\n| --- | --- |";
  for (std::size_t k = 0; k < std::size(stability::kReflectances); ++k) table += " --- |";
  table += " --- | --- |\n";
  for (const stability::StiffRoom& stiff : stability::stiff_rooms()) {
    const stability::Iterations i = stability::iterate(stiff);
    table += fmt::format("| {} | {} |", stiff.name, i.patches);
    for (std::size_t k = 0; k < i.with_clusters.size(); ++k) {
      table += fmt::format(" {} ({}) |", i.with_clusters[k], i.without_clusters[k]);
    }
    table += fmt::format(" {} | {:.1e} |\n", stiff.most_iterations, i.error);
  }
  return table;
}

std::string cases_table() {
  std::string table =
      "\n## Extreme cases\n\nErrors are relative, the largest over patches, receivers and "
      "truths.\n\n"
      "| Case | What could fail | What the engine does | Truth | Error | Limit |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (const stability::Case& c : stability::cases()) {
    table += fmt::format("| {} | {} | {} | {} | {:.1e} | {:.0e} |\n", c.name, c.danger, c.remedy,
                         c.truth, c.error(), c.limit);
  }
  return table;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: stability_page PAGE.md\n");
    return 2;
  }
  try {
    const std::string page = kHead + iterations_table() + cases_table();
    const std::filesystem::path path = argv[1], unfinished = path.string() + ".unfinished";
    std::ofstream file(unfinished);
    file << page;
    file.close();
    if (!file) throw std::runtime_error("cannot write " + unfinished.string());
    std::filesystem::rename(unfinished, path);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
