#include "apps/sha256.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>
#include <span>

#include "appearance/spectra/input_error.h"

namespace apps {

std::string sha256_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                        &EVP_MD_CTX_free);
  bool hashed = file && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
  std::array<char, 1 << 16> block{};
  while (hashed && (file.read(block.data(), block.size()), file.gcount() > 0)) {
    hashed =
        EVP_DigestUpdate(context.get(), block.data(), static_cast<std::size_t>(file.gcount())) == 1;
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  hashed = hashed && !file.bad() && EVP_DigestFinal_ex(context.get(), digest.data(), &size) == 1;
  if (!hashed) throw spectra::FileError(fmt::format("{}: cannot be read", path.string()));
  return fmt::format("{:02x}", fmt::join(std::span(digest).first(size), ""));
}

}  // namespace apps
