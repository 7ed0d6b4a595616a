#include <tamis/observe/atomic_file.hpp>

#include "catch.hpp"
#include "scratch.hpp"
#include "unit/complaint.hpp"

#include <optional>

TEST_CASE("a file appears at commit, whole") {
    const scratch_folder folder("atomic_file_commit");
    {
        tamis::atomic_file file(folder / "below/it.txt");
        file.out() << 0.1;
        CHECK_FALSE(std::filesystem::exists(folder / "below/it.txt"));
        file.commit();
        CHECK(text_of(folder / "below/it.txt") == "0.10000000000000001");
    }
    CHECK(text_of(folder / "below/it.txt") == "0.10000000000000001");
    CHECK_FALSE(std::filesystem::exists(folder / "below/it.txt.part"));
}

TEST_CASE("without commit an old file stays and nothing is left over") {
    const scratch_folder folder("atomic_file_none");
    std::ofstream(folder / "it.txt") << "old";
    { tamis::atomic_file(folder / "it.txt").out() << "new"; }
    CHECK(text_of(folder / "it.txt") == "old");
    CHECK(folder.names() == std::vector<std::string>{"it.txt"});
}

TEST_CASE("a file may be closed long before its commit, and moved") {
    const scratch_folder folder("atomic_file_close");
    std::vector<tamis::atomic_file> files;
    for (int k = 0; k < 3000; ++k) {
        files.emplace_back(folder / std::to_string(k)).out() << k;
        files.back().close();
    }
    CHECK(folder.names().size() == 3000);
    for (auto& file : files) file.commit();
    CHECK(text_of(folder / "2999") == "2999");
}

TEST_CASE("a place that cannot be written to is refused at once") {
    const scratch_folder folder("atomic_file_refused");
    std::ofstream(folder / "file") << "";
    REQUIRE_THROWS_AS(tamis::atomic_file(folder / "file/below.txt"), tamis::error);
    REQUIRE_THROWS_AS(tamis::atomic_file(folder.path()), tamis::error);
    CHECK(folder.names() == std::vector<std::string>{"file"});
    REQUIRE_THROWS_AS(tamis::atomic_file("/dev/null"), tamis::error);
    CHECK(std::filesystem::is_character_file("/dev/null"));
}

#if defined(__linux__)
TEST_CASE("a disk that is full is told, and leaves the old file and nothing beside it") {
    const scratch_folder folder("atomic_file_full");
    std::ofstream(folder / "it.txt") << "old";
    // What is written to the draft goes nowhere.
    std::filesystem::create_symlink("/dev/full", folder / "it.txt.part");
    tamis::atomic_file file(folder / "it.txt");
    file.out() << "new";
    CHECK(names(complaint([&] { file.commit(); }), "writing", "it.txt", "failed", "disk full"));
    CHECK(text_of(folder / "it.txt") == "old");
    CHECK(folder.names() == std::vector<std::string>{"it.txt"});
}
#endif

TEST_CASE("a draft that cannot take its place is told, and not left over") {
    const scratch_folder folder("atomic_file_in_the_way");
    tamis::atomic_file file(folder / "it.txt");
    file.out() << "new";
    std::filesystem::create_directories(folder / "it.txt/below");
    CHECK(names(complaint([&] { file.commit(); }), "cannot put", "it.txt", "in place"));
    CHECK(folder.names() == std::vector<std::string>{"it.txt"});
}
