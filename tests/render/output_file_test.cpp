// A file appears whole or not at all; what was there before survives every failure.
#include "render/output_file.hpp"

#include "output_support.hpp"
#include "render/exr_io.hpp"
#include "render/png_io.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <csignal>
#include <thread>

#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace lanecast;
using namespace lanecast::test;

namespace {

void write_whole(const std::filesystem::path& path, const std::string& content) {
    OutputFile file(path);
    file.write(content.data(), content.size());
    file.commit();
}

std::string letters(std::size_t count, char first = 'a') {
    std::string text(count, first);
    for (std::size_t i = 0; i < count; ++i) text[i] = static_cast<char>(first + i % 13);
    return text;
}

Film noise(int width, int height) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    return film_of(width, height, {0, 0, width, height}, [&](int, int, int) { return uniform(random); });
}

Picture8 noise8(int width, int height) {
    Picture8 picture{width, height, ZeroVector<std::uint8_t>(static_cast<std::size_t>(3 * width * height))};
    std::mt19937 random(8);
    for (auto& code : picture.rgb) code = static_cast<std::uint8_t>(random());
    return picture;
}

/// No file of this process grows beyond `bytes`, as if the disk were full there.
struct FileSizeLimit {
    rlimit before{};
    explicit FileSizeLimit(rlim_t bytes) {
        std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before);
        const rlimit limit{bytes, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before); }
};

/// Root may do everything; as nobody, permissions count. Does nothing for other users.
struct AsNobody {
    const bool was_root = geteuid() == 0;
    AsNobody() {
        if (was_root) REQUIRE(seteuid(65534) == 0);
    }
    ~AsNobody() {
        if (was_root) static_cast<void>(seteuid(0));
    }
};

/// `action` fails with `reason`; the file `old` in `directory` is as before and alone.
template <class Action>
void check_fails_cleanly(const std::filesystem::path& directory, const std::string& reason, const Action& action) {
    const std::filesystem::path path = directory / "old";
    put(path, "precious");
    const Error error = error_of([&] { action(path); });
    CHECK(error.code() == ExitCode::output);
    CHECK(std::string(error.what()) == path.string() + ": cannot write: " + reason);
    CHECK(content_of(path) == "precious");
    CHECK(names_in(directory) == std::vector<std::string>{"old"});
}

void check_all_writers_fail_cleanly(const std::filesystem::path& directory, const std::string& reason) {
    check_fails_cleanly(directory, reason, [](const auto& path) { write_whole(path, letters(1 << 20)); });
    check_fails_cleanly(directory, reason, [](const auto& path) { write_exr(path, noise(300, 200)); });
    check_fails_cleanly(directory, reason, [](const auto& path) {
        write_exr(path, noise(300, 200), {.float_pixels = true, .threads = 2, .attributes = {}});
    });
    check_fails_cleanly(directory, reason, [](const auto& path) { write_png(path, noise8(300, 200)); });
}

} // namespace

TEST_CASE("what was written is what the file holds, at any sizes and positions") {
    const TemporaryDirectory directory;
    std::mt19937 random(1);
    for (int trial = 0; trial < 60; ++trial) {
        const auto path = directory.path / "file";
        std::string expected;
        OutputFile file(path);
        for (int step = 0; step < 12; ++step) {
            const std::string piece = letters(random() % (step % 4 == 0 ? 600000 : 3000), static_cast<char>('A' + step));
            if (random() % 4 == 0) REQUIRE(file.seek(random() % (expected.size() + 1)));
            const std::size_t at = file.position();
            REQUIRE(file.write(piece.data(), piece.size()));
            CHECK(file.position() == at + piece.size());
            if (at + piece.size() > expected.size()) expected.resize(at + piece.size());
            expected.replace(at, piece.size(), piece);
            if (file.position() != expected.size()) REQUIRE(file.seek(expected.size()));
        }
        file.commit();
        CHECK(content_of(path) == expected);
    }
    CHECK(names_in(directory.path).size() == 1);
}

TEST_CASE("until commit, the old file stands and the temporary is recognisable; without it nothing is left") {
    const TemporaryDirectory directory;
    const auto path = directory.path / "out.exr";
    put(path, "old");
    {
        OutputFile first(path), second(path);
        first.write("new", 3);
        CHECK(content_of(path) == "old");
        int temporaries = 0;
        for (const std::string& name : names_in(directory.path))
            temporaries +=
                name.starts_with(".out.exr.lanecast-" + std::to_string(getpid()) + "-") && name.ends_with(".tmp") ? 1 : 0;
        CHECK(temporaries == 2);
    }
    CHECK(content_of(path) == "old");
    CHECK(names_in(directory.path).size() == 1);
}

TEST_CASE("a full disk leaves the old file and no temporary") {
    const TemporaryDirectory directory;
    SUBCASE("a limit on file sizes") {
        for (const rlim_t limit : {rlim_t{0}, rlim_t{200}, rlim_t{5000}, rlim_t{100000}}) {
            put(directory.path / "old", "precious");
            const FileSizeLimit full(limit);
            // The limit binds the test's own `put` too: it writes what fits.
            if (limit >= 200)
                check_all_writers_fail_cleanly(directory.path, "File too large");
            else
                CHECK(error_of([&] { write_exr(directory.path / "new", noise(3, 2)); }).code() == ExitCode::output);
        }
        CHECK(names_in(directory.path) == std::vector<std::string>{"old"});
    }
    SUBCASE("a file system of 64 KiB") {
        if (mount("tmpfs", directory.path.c_str(), "tmpfs", 0, "size=64k") != 0) {
            MESSAGE("skipped: this user cannot mount a small file system");
            return;
        }
        check_all_writers_fail_cleanly(directory.path, "No space left on device");
        umount2(directory.path.c_str(), MNT_DETACH);
    }
}

TEST_CASE("a target that cannot be written is named with the reason") {
    const TemporaryDirectory directory;
    const auto message = [](const std::filesystem::path& path) {
        const Error error = error_of([&] { write_whole(path, "x"); });
        CHECK(error.code() == ExitCode::output);
        return std::string(error.what());
    };
    const auto said = [](const std::filesystem::path& path, const std::string& reason) {
        return path.string() + ": cannot write: " + reason;
    };

    const auto missing = directory.path / "no" / "where" / "out.exr";
    CHECK(message(missing) == said(missing, "the directory " + (directory.path / "no" / "where").string() + " does not exist"));
    CHECK(message("no_such_directory_here/x.png") ==
          "no_such_directory_here/x.png: cannot write: the directory no_such_directory_here does not exist");
    CHECK(message(directory.path) == said(directory.path, "Is a directory"));
    CHECK(message(directory.path / "") == said(directory.path / "", "Is a directory"));
    CHECK(message("") == "'': cannot write: the file name is empty");
    put(directory.path / "file", "");
    CHECK(message(directory.path / "file" / "x.exr") == said(directory.path / "file" / "x.exr", "Not a directory"));
    CHECK(message(directory.path / "new" / "") == said(directory.path / "new" / "", "No such file or directory"));
    CHECK(message("/dev/null") == "/dev/null: cannot write: it exists and is not a regular file");
    REQUIRE(mkfifo((directory.path / "pipe").c_str(), 0600) == 0);
    CHECK(contains(message(directory.path / "pipe"), "not a regular file"));
    const auto too_long = directory.path / std::string(300, 'n');
    CHECK(message(too_long) == said(too_long, "File name too long"));
}

TEST_CASE("permissions are respected: of the directory, and of a read-only file") {
    const TemporaryDirectory directory;
    const auto closed = directory.path / "closed", open = directory.path / "open";
    std::filesystem::create_directory(closed);
    std::filesystem::create_directory(open);
    put(closed / "old", "precious");
    put(open / "old", "precious");
    chmod(directory.path.c_str(), 0755);
    chmod(closed.c_str(), 0555);
    chmod(open.c_str(), 0777);
    chmod((closed / "old").c_str(), 0666);
    chmod((open / "old").c_str(), 0444);
    {
        const AsNobody nobody;
        for (const auto& path : {closed / "old", closed / "new", open / "old"}) {
            const Error error = error_of([&] { write_exr(path, noise(5, 5)); });
            CHECK(error.code() == ExitCode::output);
            CHECK(std::string(error.what()) == path.string() + ": cannot write: Permission denied");
        }
        CHECK(error_of([&] { write_exr(open / "new", noise(5, 5)); }).code() == ExitCode::done);
    }
    CHECK(content_of(closed / "old") == "precious");
    CHECK(content_of(open / "old") == "precious");
    CHECK(names_in(closed).size() == 1);
    CHECK(names_in(open).size() == 2);
    chmod(closed.c_str(), 0755);
}

TEST_CASE("a new file has the usual permissions, a replaced one keeps its own, a link is followed") {
    const TemporaryDirectory directory;
    const auto mode = [](const std::filesystem::path& path) {
        struct stat status {};
        stat(path.c_str(), &status);
        return status.st_mode & 0777u;
    };
    const mode_t mask = umask(027);
    write_whole(directory.path / "new", "x");
    umask(mask);
    CHECK(mode(directory.path / "new") == 0640);
    chmod((directory.path / "new").c_str(), 0604);
    write_whole(directory.path / "new", "y");
    CHECK(mode(directory.path / "new") == 0604);

    std::filesystem::create_directory(directory.path / "sub");
    put(directory.path / "sub" / "real", "old");
    std::filesystem::create_symlink("sub/real", directory.path / "link");
    write_whole(directory.path / "link", "through");
    CHECK(std::filesystem::is_symlink(directory.path / "link"));
    CHECK(content_of(directory.path / "sub" / "real") == "through");
    std::filesystem::create_symlink("sub/new", directory.path / "to_nothing");
    std::filesystem::create_symlink("to_nothing", directory.path / "to_link");
    write_whole(directory.path / "to_link", "made");
    CHECK(std::filesystem::is_symlink(directory.path / "to_link"));
    CHECK(std::filesystem::is_symlink(directory.path / "to_nothing"));
    CHECK(content_of(directory.path / "sub" / "new") == "made");
    std::filesystem::create_symlink("circle", directory.path / "circle");
    CHECK_THROWS_AS(write_whole(directory.path / "circle", "x"), Error);
    std::filesystem::create_symlink("missing/new", directory.path / "astray");
    CHECK_THROWS_AS(write_whole(directory.path / "astray", "x"), Error);
    const auto long_name = directory.path / std::string(255, 'n');
    write_whole(long_name, "z");
    CHECK(content_of(long_name) == "z");
}

TEST_CASE("a process that dies while it writes leaves the old file") {
    const TemporaryDirectory directory;
    const auto path = directory.path / "out.exr";
    put(path, "old");
    const pid_t child = fork();
    if (child == 0) {
        OutputFile file(path);
        const std::string half = letters(1 << 20);
        file.write(half.data(), half.size());
        kill(getpid(), SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status));
    CHECK(content_of(path) == "old");
    write_whole(path, "new"); // the orphan is in nobody's way
    CHECK(content_of(path) == "new");
}

TEST_CASE("whoever looks while files are replaced sees one or the other, whole") {
    const TemporaryDirectory directory;
    const auto path = directory.path / "out";
    const std::string contents[2] = {letters(400000, 'a'), letters(300000, 'n')};
    write_whole(path, contents[0]);
    std::atomic<bool> done = false;
    std::thread writer([&] {
        for (int i = 0; i < 200; ++i) write_whole(path, contents[i % 2]);
        done = true;
    });
    int looks = 0, torn = 0;
    while (!done || looks == 0) {
        const std::string seen = content_of(path);
        torn += seen == contents[0] || seen == contents[1] ? 0 : 1;
        ++looks;
    }
    writer.join();
    CHECK(looks > 0);
    CHECK(torn == 0);
}
