/* Results: values and errors, what comes next, and what ends the program. */
#include "check.hpp"

#include <memory>

namespace {

using bespoke::Error;
using bespoke::Result;
using bespoke::Status;

Error busy() { return Error(Status::busy, "not now"); }

Result<int> half(int number) {
    if (number % 2 != 0) return Error(Status::invalid_argument, "odd");
    return number / 2;
}

void values() {
    Result<std::string> good = std::string("text");
    CHECK(good && good.status() == Status::ok && good.message().empty());
    CHECK(good.value() == "text" && *good == "text" && good->size() == 4);
    good->push_back('s');
    const Result<std::string> fixed = good;
    CHECK(fixed.value() == "texts" && *fixed == "texts" && fixed->size() == 5 && fixed.value_or("other") == "texts");
    const std::string moved = std::move(good).value();
    CHECK(moved == "texts");
    // Values that can be moved only.
    Result<std::unique_ptr<int>> alone = std::make_unique<int>(7);
    CHECK(**alone == 7);
    const std::unique_ptr<int> taken = std::move(alone).value_or(nullptr);
    CHECK(*taken == 7);
    CHECK(Result<void>() && Result<void>().status() == Status::ok);
    Result<void>().value();
}

void errors() {
    const Result<int> bad = busy();
    CHECK(!bad && bad.status() == Status::busy && bad.message() == "not now" && bad.value_or(3) == 3);
    CHECK(bad.error().status() == Status::busy && std::strcmp(bad.error().what(), "not now") == 0);
    // An error goes on through functions with other results.
    const Result<void> further = bad.error();
    CHECK(!further && further.message() == "not now" && further.error().message() == "not now");
}

void chains() {
    CHECK(half(8).and_then(half).and_then(half).value() == 1);
    CHECK(half(6).and_then(half).message() == "odd");
    int calls = 0;
    const auto count = [&]() -> Result<void> {
        if (calls++ == 1) return busy();
        return {};
    };
    CHECK(count().and_then(count).and_then(count).status() == Status::busy && calls == 2);
    const auto text = Result<void>().and_then([] { return Result<std::string>("next"); });
    CHECK(text && *text == "next");
}

#ifdef __cpp_exceptions
void exceptions() {
    CHECK(half(8).or_throw() == 4);
    Result<void>().or_throw();
    int caught = 0;
    try {
        half(7).or_throw();
    } catch (const Error &error) {
        CHECK(error.status() == Status::invalid_argument && error.message() == "odd");
        caught++;
    }
    try {
        Result<void>(busy()).or_throw();
    } catch (const std::exception &error) {
        CHECK(std::strcmp(error.what(), "not now") == 0);
        caught++;
    }
    const Result<int> named = half(8), bad = half(7);
    CHECK(named.or_throw() == 4 && &named.or_throw() == &named.value());
    try {
        static_cast<void>(bad.or_throw());
    } catch (const Error &error) {
        CHECK(error.message() == "odd" && bad.message() == "odd");
        caught++;
    }
    // As a program with exceptions is written.
    try {
        auto session = bespoke::Session::create().or_throw();
        session.run().or_throw();
    } catch (const Error &error) {
        CHECK(error.status() == Status::invalid_state && !error.message().empty());
        caught++;
    }
    CHECK(caught == 4);
}
#endif

void names() {
    CHECK(std::strcmp(bespoke::status_name(Status::not_enclosed), "BESPOKE_STATUS_NOT_ENCLOSED") == 0);
    // What a later library may say.
    CHECK(std::strcmp(bespoke::status_name(static_cast<Status>(1000)), "BESPOKE_STATUS_UNKNOWN") == 0);
    CHECK(bespoke::abi_version() == BESPOKE_ABI_VERSION && std::strlen(bespoke::version_text()) >= 5);
    CHECK(bespoke::weight_off < 0 && bespoke::max_terms == BESPOKE_MAX_TERMS);
}

} // namespace

void results() {
    values();
    errors();
    chains();
#ifdef __cpp_exceptions
    exceptions();
#endif
    names();
}

void mistake(const char *name) {
    const Result<int> bad = busy();
    const Result<void> failed = busy();
    const Result<std::string> good("text");
    if (std::strcmp(name, "value") == 0) std::printf("%d\n", bad.value());
    if (std::strcmp(name, "star") == 0) std::printf("%d\n", *bad);
    if (std::strcmp(name, "void") == 0) failed.value();
    if (std::strcmp(name, "error") == 0) std::printf("%s\n", good.error().what());
    if (std::strcmp(name, "session") == 0) {
        Result<bespoke::Session> none = busy();
        static_cast<void>(none->run());
    }
}
