// Are the answers right? By counting on the host, for a sample: no tree, no list.
#pragma once
#include <thread>

#include "photons.h"
#include "search.h"

struct Truth {
    uint32_t checked = 0, wrong = 0;
};

// A k-th distance is right if, and only if, fewer than k photons are nearer and at least k are as near.
inline bool is_right(const std::vector<Record>& photons, Vector point, Answer answer) {
    size_t nearer = 0, as_near = 0;
    uint32_t checksum = 0;
    for (const Record& photon : photons) {
        const float distance = distance_squared(point, photon.position());
        if (!(distance <= answer.farthest)) continue;
        ++as_near;
        if (distance < answer.farthest) {
            ++nearer;
            checksum += bits_of(distance);
        }
    }
    const size_t k = std::min<size_t>(K, photons.size());
    checksum += uint32_t(k - nearer) * bits_of(answer.farthest);
    return nearer < k && k <= as_near && checksum == answer.checksum;
}

// Every n-th query, of a sample of so many.
inline Truth compare_with_truth(const std::vector<Record>& photons, const std::vector<float>& queries, const std::vector<Answer>& answers,
                                uint32_t sample) {
    const size_t step = std::max<size_t>(1, answers.size() / std::max(1u, sample));
    const size_t threads = std::max(1u, std::thread::hardware_concurrency());
    std::vector<Truth> parts(threads);
    std::vector<std::thread> workers;
    for (size_t worker = 0; worker < threads; ++worker)
        workers.emplace_back([&, worker] {
            for (size_t at = worker * step; sample > 0 && at < answers.size(); at += threads * step) {
                const Vector point{queries[at * 3], queries[at * 3 + 1], queries[at * 3 + 2]};
                ++parts[worker].checked;
                parts[worker].wrong += !is_right(photons, point, answers[at]);
            }
        });
    for (std::thread& worker : workers) worker.join();
    Truth sum;
    for (const Truth& part : parts) {
        sum.checked += part.checked;
        sum.wrong += part.wrong;
    }
    return sum;
}

// The same in whatever order queries come: a sum over all of a hash of query and answer.
inline uint64_t digest(const std::vector<float>& queries, const std::vector<Answer>& answers) {
    uint64_t sum = 0;
    for (size_t at = 0; at < answers.size(); ++at) {
        uint64_t hash = 0x9e3779b97f4a7c15;
        for (uint32_t word : {bits_of(queries[at * 3]), bits_of(queries[at * 3 + 1]), bits_of(queries[at * 3 + 2]),
                              bits_of(answers[at].farthest), answers[at].checksum}) {
            // The finaliser of SplitMix64.
            hash = (hash ^ word) * 0xbf58476d1ce4e5b9;
            hash = (hash ^ hash >> 27) * 0x94d049bb133111eb;
            hash ^= hash >> 31;
        }
        sum += hash;
    }
    return sum;
}

// Mean and quantiles of the k-th distance, as `pm-gather --report` tells them: quantiles to ten bits of the fraction.
inline std::string distances(const std::vector<Answer>& answers) {
    std::vector<float> sorted;
    double sum = 0;
    for (const Answer& answer : answers) {
        sorted.push_back(std::sqrt(answer.farthest));
        sum += double(sorted.back());
    }
    std::sort(sorted.begin(), sorted.end());
    const auto quantile = [&](double share) {
        const size_t at = std::min(size_t(share * double(sorted.size())), sorted.size() - 1);
        return double(number_of(bits_of(sorted[at]) >> 13 << 13));
    };
    char text[300];
    std::snprintf(text, sizeof text,
                  "\"distance_mean\": %.17g, \"distance_p5\": %.17g, \"distance_p50\": %.17g, \"distance_p95\": %.17g, \"distance_largest\": %.17g",
                  sum / double(sorted.size()), quantile(0.05), quantile(0.5), quantile(0.95), quantile(1));
    return sorted.empty() ? "\"distance_mean\": 0" : text;
}
