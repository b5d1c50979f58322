/* Sorts and sums some numbers: loads, stores and modifies of a program that is small. */
static unsigned numbers[1500];
static unsigned histogram[4096];
static unsigned long total;
int main(void) {
    unsigned state = 12345;
    for (int i = 0; i < 1500; i++) {
        state = state * 1664525u + 1013904223u;
        numbers[i] = state >> 8;
        histogram[numbers[i] & 4095]++;
    }
    for (int gap = 750; gap > 0; gap /= 2)
        for (int i = gap; i < 1500; i++)
            for (int j = i - gap; j >= 0 && numbers[j] > numbers[j + gap]; j -= gap) {
                unsigned t = numbers[j];
                numbers[j] = numbers[j + gap];
                numbers[j + gap] = t;
            }
    for (int i = 0; i < 1500; i++) total += numbers[i] ^ histogram[i & 4095];
    return total == 0;
}
