// Runs a fuzzer's entry point on mutations of a corpus, reproducibly and with any compiler.
//
//     fuzz_case_file_short CORPUS_DIRECTORY EXECUTIONS [SEED]

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "shared/parameters/parameter_table.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Texts = std::vector<std::string>;

Texts read_corpus(const std::filesystem::path& directory) {
    std::vector<std::filesystem::path> files(std::filesystem::directory_iterator(directory), {});
    std::sort(files.begin(), files.end());
    Texts texts;
    for (const auto& file : files) {
        std::ifstream stream(file, std::ios::binary);
        texts.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    }
    return texts;
}

Texts tokens() {
    Texts words{"=",    "\n",         "[",     "]",      "\"",      "'",      "\"\"\"", "{",
                "}",    ",",          ".",     "#",      "\\u0000", "\\x",    "true",   "nan",
                "inf",  "-inf",       "1e300", "-1e300", "1e999",   "5e-324", "-0.0",   "9223372036854775807",
                "0x7f", "1979-05-27", "[[",    "]]",     "\r\n",    "\xff"};
    words.emplace_back(1, '\0');
    for (const auto& row : endoflow::parameter_table()) {
        words.push_back("[" + row.section + "]\n");
        words.push_back(row.key + " = ");
        words.push_back('\0' + row.name() + "=");
        words.insert(words.end(), row.choices.begin(), row.choices.end());
    }
    return words;
}

class Mutator {
  public:
    Mutator(std::uint64_t seed, Texts corpus) : random_(seed), corpus_(std::move(corpus)), tokens_(tokens()) {}

    std::string next() {
        std::string text = any(corpus_);
        for (std::size_t i = 0, count = 1 + below(8); i < count; ++i) mutate(text);
        if (text.size() > longest) text.resize(longest);
        return text;
    }

  private:
    static constexpr std::size_t longest = 1 << 14;
    std::mt19937_64 random_;
    Texts corpus_;
    Texts tokens_;

    // In [0, n); the same on every platform.
    std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
    const std::string& any(const Texts& texts) { return texts[below(texts.size())]; }

    void mutate(std::string& text) {
        const std::size_t place = below(text.size() + 1), length = below(text.size() - place + 1);
        switch (below(6)) {
            case 0:
                if (place < text.size()) text[place] = static_cast<char>(text[place] ^ (1 << below(8)));
                break;
            case 1:
                text.insert(place, 1, static_cast<char>(below(256)));
                break;
            case 2:
                text.erase(place, below(length + 1));
                break;
            case 3:
                text.insert(below(text.size() + 1), text.substr(place, length));
                break;
            case 4:
                text.insert(place, any(tokens_));
                break;
            default: {
                const std::string& other = any(corpus_);
                const std::size_t from = below(other.size() + 1);
                text.replace(place, length, other.substr(from));
            }
        }
    }
};

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: %s CORPUS_DIRECTORY EXECUTIONS [SEED]\n", argv[0]);
        return 2;
    }
    Texts corpus = read_corpus(argv[1]);
    if (corpus.empty()) {
        std::fprintf(stderr, "%s: holds no files to start from\n", argv[1]);
        return 2;
    }
    const long executions = std::strtol(argv[2], nullptr, 10);
    Mutator mutator(argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1, std::move(corpus));
    for (long i = 0; i < executions; ++i) {
        const std::string text = mutator.next();
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    }
    std::printf("%ld executions\n", executions);
}
