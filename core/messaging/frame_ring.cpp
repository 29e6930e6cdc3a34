#include "core/messaging/frame_ring.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <random>
#include <signal.h>
#include <stdexcept>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace goalmouth {

namespace {
constexpr std::uint64_t ring_magic = 0x474D52494E473031;  // "GMRING01"
constexpr std::uint32_t ring_version = 1;
constexpr std::size_t page = 4096;
constexpr int most_slots = 64;
constexpr std::size_t most_slot_bytes = std::size_t{1} << 30;
constexpr std::size_t kept_mappings = 4;
constexpr const char* shared_memory_folder = "/dev/shm";
}  // namespace

/// The start of the shared memory; slot i begins at data_offset + i·slot_bytes, both whole pages.
struct RingLayout {
    struct alignas(64) Slot {  // a cache line each: readers of one slot do not disturb the writing of another
        std::atomic<std::uint64_t> generation;
    };

    std::atomic<std::uint64_t> magic;  // written last
    std::uint32_t version;
    std::uint32_t slots;
    std::uint64_t slot_bytes;
    std::uint64_t data_offset;
    Slot slot[most_slots];
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "shared between processes");

namespace {

constexpr std::size_t whole_pages(std::size_t bytes) {
    return (bytes + page - 1) / page * page;
}
constexpr std::size_t data_offset = whole_pages(sizeof(RingLayout));

/// Where slot i begins, by numbers that were checked: the header could change under a reader's eyes.
std::size_t slot_offset(std::size_t i, std::size_t slot_bytes) {
    return data_offset + i * slot_bytes;
}

std::string prefix_of_user() {
    return "goalmouth-" + std::to_string(getuid()) + "-";
}

std::string new_name(const std::string& camera) {
    std::string name = "/";
    name += prefix_of_user() + std::to_string(getpid()) + "-";
    for (const char c : camera.substr(0, 64)) {
        name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    }
    std::random_device random;
    return name + "-" + std::to_string(random());
}

bool is_ring_name(const std::string& name) {
    return name.starts_with("/goalmouth-") && name.size() <= 255 && name.find('/', 1) == std::string::npos &&
           name.find('\0') == std::string::npos;
}

/// posix_fallocate, because a hole in a full /dev/shm shows only as a SIGBUS of whoever writes there.
int allocate(int fd, std::size_t bytes) {
    int error = 0;
    do {
        error = posix_fallocate(fd, 0, static_cast<off_t>(bytes));
    } while (error == EINTR);
    return error;
}

bool is_alive(pid_t pid) {
    return kill(pid, 0) == 0 || errno != ESRCH;
}

}  // namespace

FrameRing::FrameRing(const std::string& camera, int slots, std::size_t slot_bytes)
    : slots_(slots), slot_bytes_(whole_pages(slot_bytes)) {
    if (slots < 2 || slots > most_slots || slot_bytes < 1 || slot_bytes > most_slot_bytes) {
        throw std::invalid_argument("a frame ring has 2 to 64 slots of 1 byte to 1 GiB");
    }
    remove_stale_rings();
    name_ = new_name(camera);
    fd_ = shm_open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (fd_ < 0) throw std::runtime_error("cannot make shared memory " + name_ + ": " + std::strerror(errno));
    // Held as long as the producer lives, however it ends: see remove_stale_rings().
    flock(fd_, LOCK_EX | LOCK_NB);

    mapped_bytes_ = data_offset + static_cast<std::size_t>(slots) * slot_bytes_;
    const auto give_up = [this](const std::string& why) {
        shm_unlink(name_.c_str());
        close(fd_);
        throw std::runtime_error("no shared memory for " + std::to_string(slots_) + " frames of " +
                                 std::to_string(slot_bytes_) + " bytes: " + why +
                                 "; make room in /dev/shm (\"df /dev/shm\" shows it) or use fewer slots");
    };
    if (const int error = allocate(fd_, mapped_bytes_); error != 0) give_up(std::strerror(error));
    void* memory = mmap(nullptr, mapped_bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, fd_, 0);
    if (memory == MAP_FAILED) give_up(std::strerror(errno));
    ring_ = static_cast<RingLayout*>(memory);  // zero pages: every generation is 0
    ring_->version = ring_version;
    ring_->slots = static_cast<std::uint32_t>(slots);
    ring_->slot_bytes = slot_bytes_;
    ring_->data_offset = data_offset;
    ring_->magic.store(ring_magic, std::memory_order_release);
}

FrameRing::~FrameRing() {
    munmap(ring_, mapped_bytes_);
    shm_unlink(name_.c_str());
    close(fd_);
}

std::span<std::uint8_t> FrameRing::begin_write(std::size_t size) {
    if (size > slot_bytes_) throw std::invalid_argument("a frame larger than its ring's slots");
    const auto slot = static_cast<std::size_t>(next_);
    ring_->slot[slot].generation.store(static_cast<std::uint64_t>(generation_) + 1,
                                       std::memory_order_relaxed);
    // No pixel may become visible before the odd generation.
    std::atomic_thread_fence(std::memory_order_release);
    return {reinterpret_cast<std::uint8_t*>(ring_) + slot_offset(slot, slot_bytes_), size};
}

RingPlace FrameRing::finish_write() {
    const RingPlace place{next_, generation_ + 2};
    ring_->slot[static_cast<std::size_t>(next_)].generation.store(
        static_cast<std::uint64_t>(place.generation), std::memory_order_release);
    generation_ = place.generation;
    next_ = (next_ + 1) % slots_;
    return place;
}

bool RingFrame::still_valid() const {
    // No pixel may be read after the generation.
    std::atomic_thread_fence(std::memory_order_acquire);
    return ring_->slot[slot_].generation.load(std::memory_order_relaxed) == generation_;
}

const RingReader::Mapping* RingReader::mapped(const std::string& name) {
    const auto found =
        std::find_if(mappings_.begin(), mappings_.end(), [&](const Mapping& m) { return m.name == name; });
    if (found != mappings_.end()) {
        std::rotate(found, found + 1, mappings_.end());
        return &mappings_.back();
    }

    failure_ = RingFailure::refused;
    if (!is_ring_name(name)) return nullptr;
    const int fd = shm_open(name.c_str(), O_RDONLY | O_CLOEXEC, 0);
    if (fd < 0) {
        if (errno == ENOENT) failure_ = RingFailure::gone;
        return nullptr;
    }
    struct stat status {};
    const bool readable = fstat(fd, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid() &&
                          status.st_size >= static_cast<off_t>(data_offset);
    const auto size = readable ? static_cast<std::size_t>(status.st_size) : 0;
    void* memory = readable ? mmap(nullptr, size, PROT_READ, MAP_SHARED, fd, 0) : MAP_FAILED;
    close(fd);
    if (memory == MAP_FAILED) return nullptr;

    const std::shared_ptr<const RingLayout> ring(static_cast<const RingLayout*>(memory),
                                                 [memory, size](const RingLayout*) { munmap(memory, size); });
    const Mapping mapping{name, ring, ring->slots, ring->slot_bytes};
    const bool sound = ring->magic.load(std::memory_order_acquire) == ring_magic &&
                       ring->version == ring_version && ring->data_offset == data_offset &&
                       mapping.slots >= 2 && mapping.slots <= most_slots && mapping.slot_bytes >= 1 &&
                       mapping.slot_bytes <= most_slot_bytes &&
                       slot_offset(mapping.slots, mapping.slot_bytes) <= size;
    if (!sound) return nullptr;
    if (mappings_.size() == kept_mappings) mappings_.erase(mappings_.begin());
    mappings_.push_back(mapping);
    return &mappings_.back();
}

std::optional<RingFrame> RingReader::try_open(const image_t& descriptor) {
    const Mapping* mapping = mapped(descriptor.ring);
    if (mapping == nullptr) return {};
    failure_ = RingFailure::refused;
    if (descriptor.slot < 0 || static_cast<std::size_t>(descriptor.slot) >= mapping->slots) return {};
    if (descriptor.size < 0 || static_cast<std::size_t>(descriptor.size) > mapping->slot_bytes) return {};
    if (descriptor.generation <= 0 || descriptor.generation % 2 != 0) return {};

    RingFrame frame;
    frame.ring_ = mapping->ring;
    frame.slot_ = static_cast<std::size_t>(descriptor.slot);
    frame.generation_ = static_cast<std::uint64_t>(descriptor.generation);
    const auto* start = reinterpret_cast<const std::uint8_t*>(mapping->ring.get());
    frame.bytes_ = {start + slot_offset(frame.slot_, mapping->slot_bytes),
                    static_cast<std::size_t>(descriptor.size)};
    if (mapping->ring->slot[frame.slot_].generation.load(std::memory_order_acquire) != frame.generation_) {
        failure_ = RingFailure::overwritten;
        return {};
    }
    failure_ = RingFailure::none;
    return frame;
}

int remove_stale_rings() {
    int removed = 0;
    std::error_code error;
    const std::string prefix = prefix_of_user();
    for (const auto& entry : std::filesystem::directory_iterator(shared_memory_folder, error)) {
        const std::string file = entry.path().filename().string();
        if (!file.starts_with(prefix)) continue;
        pid_t pid = 0;
        const char* digits = file.data() + prefix.size();
        const auto [stop, parsed] = std::from_chars(digits, file.data() + file.size(), pid);
        if (parsed != std::errc() || stop == file.data() + file.size() || *stop != '-' || pid <= 0 ||
            is_alive(pid))
            continue;
        // A producer in another process namespace looks dead from here, but holds its lock.
        const int fd = shm_open(file.c_str(), O_RDONLY | O_CLOEXEC, 0);
        if (fd < 0) continue;
        if (flock(fd, LOCK_EX | LOCK_NB) == 0 && shm_unlink(file.c_str()) == 0) ++removed;
        close(fd);
    }
    return removed;
}

}  // namespace goalmouth
