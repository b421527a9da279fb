// Runs the stiff and extreme cases and writes the page about them:
//   build/release/tests/bench/stability_page solver/stability.md
#include <fmt/format.h>

#include <chrono>
#include <fstream>

#include "tests/support/stability_cases.h"

int main(int argc, char**) {
  const auto start = std::chrono::steady_clock::now();
  const auto lap = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  for (const stability::StiffRoom& stiff : stability::stiff_rooms()) {
    const stability::Iterations i = stability::iterate(stiff);
    fmt::print("{} {} error {:.1e} t {:.2f}\n", stiff.name, i.patches, i.error, lap());
    for (int k : i.with_clusters) fmt::print(" {}", k);
    fmt::print(" |");
    for (int k : i.without_clusters) fmt::print(" {}", k);
    fmt::print("\n");
  }
  for (const stability::Case& c : stability::cases()) {
    try {
      fmt::print("{} {:.2e} t {:.2f}\n", c.name, c.error(), lap());
    } catch (const std::exception& e) {
      fmt::print("{} threw {}\n", c.name, e.what());
    }
  }
  return argc > 2;
}
