// Work that a host does with its own TBB. It is linked with none, and takes the one that is in the process.
#include <cmath>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

// 1 where all of it came out right.
extern "C" int host_work() {
    std::vector<double> values(200000);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, values.size(), 100), [&](const tbb::blocked_range<size_t>& range) {
        for (size_t k = range.begin(); k != range.end(); ++k) {
            values[k] = std::sqrt(static_cast<double>(k)) * std::sqrt(static_cast<double>(k));
        }
    });
    const double sum = tbb::parallel_reduce(
        tbb::blocked_range<size_t>(0, values.size(), 100), 0.0,
        [&](const tbb::blocked_range<size_t>& range, double part) {
            for (size_t k = range.begin(); k != range.end(); ++k) {
                part += values[k];
            }
            return part;
        },
        [](double a, double b) { return a + b; });
    const double count = static_cast<double>(values.size());
    return std::fabs(sum - count * (count - 1.0) / 2.0) < 1e-3 ? 1 : 0;
}
