(** * The checker, which computes with whole numbers, and why what it accepts is true *)

From Coq Require Import QArith ZArith List Arith Lia Bool.
From Gark Require Import Stages Trees Methods Sums.
Import ListNotations.
Open Scope Q_scope.

Definition all (n : nat) (c : nat -> bool) := forallb c (seq 0 n).
Definition table {X} (n : nat) (f : nat -> X) : list X := map f (seq 0 n).

Lemma all_at n c : all n c = true -> forall i, (i < n)%nat -> c i = true.
Proof. intros H i Hi. unfold all in H. rewrite forallb_forall in H. apply H, in_seq. lia. Qed.
Lemma nth_table {X} n (f : nat -> X) i d : (i < n)%nat -> nth i (table n f) d = f i.
Proof.
  intros H. unfold table. rewrite nth_indep with (d' := f 0%nat) by (rewrite map_length,
    seq_length; exact H).
  rewrite map_nth, seq_nth by exact H. reflexivity.
Qed.
Lemma table_length {X} n (f : nat -> X) : length (table n f) = n.
Proof. unfold table. rewrite map_length. apply seq_length. Qed.

(** ** Vectors with one denominator *)

Definition zvec := (list Z * positive)%type.
Definition val (x : zvec) : V := fun i => nth i (fst x) 0%Z # snd x.

Definition common (qs : list Q) : positive :=
  fold_right (fun q d => Z.to_pos (Z.lcm (Zpos (Qden q)) (Zpos d))) 1%positive qs.
Definition whole (D : positive) (q : Q) : Z := (Qnum q * (Zpos D / Zpos (Qden q)))%Z.
Definition over (qs : list Q) : zvec := let D := common qs in (map (whole D) qs, D).

Lemma common_divides qs q : In q qs \/ q = 0 -> (Zpos (Qden q) | Zpos (common qs))%Z.
Proof.
  assert (P : forall a b, Zpos (Z.to_pos (Z.lcm (Zpos a) (Zpos b))) = Z.lcm (Zpos a) (Zpos b)).
  { intros a b. apply Z2Pos.id. pose proof (Z.lcm_nonneg (Zpos a) (Zpos b)).
    assert (Z.lcm (Zpos a) (Zpos b) <> 0)%Z by (rewrite Z.lcm_eq_0; lia). lia. }
  intros [I| ->]; [|apply Z.divide_1_l].
  induction qs as [|r qs IH]; [contradiction|]. cbn [common fold_right]. fold (common qs).
  rewrite P. destruct I as [->|I]; [apply Z.divide_lcm_l|].
  apply Z.divide_trans with (1 := IH I), Z.divide_lcm_r.
Qed.
Lemma whole_is D q : (Zpos (Qden q) | Zpos D)%Z -> q == whole D q # D.
Proof.
  intros [k E]. unfold whole, Qeq. simpl Qnum. simpl Qden. rewrite E, Z.div_mul by discriminate.
  ring.
Qed.
Lemma over_is qs i : val (over qs) i == nth i qs 0.
Proof.
  unfold val, over. cbn [fst snd]. change 0%Z with (whole (common qs) 0). rewrite map_nth.
  symmetry. apply whole_is, common_divides. destruct (nth_in_or_default i qs 0); auto.
Qed.

Lemma same_denominator a b d : (a # d) + (b # d) == (a + b)%Z # d.
Proof. unfold Qeq, Qplus; simpl. rewrite Pos2Z.inj_mul. ring. Qed.

Fixpoint zadd (xs ys : list Z) : list Z :=
  match xs, ys with
  | [], _ => ys
  | _, [] => xs
  | x :: xs, y :: ys => (x + y)%Z :: zadd xs ys
  end.
Lemma nth_zadd i : forall xs ys, nth i (zadd xs ys) 0%Z = (nth i xs 0 + nth i ys 0)%Z.
Proof.
  induction i; intros [|x xs] [|y ys]; simpl; rewrite ?Z.add_0_r; try reflexivity. apply IHi.
Qed.

(** ** Sums Σ x^a g_a modulo a polynomial, by Horner's rule *)

(** The n-th power. *)
Definition after (D : positive) (n : nat) : positive := Nat.iter n (Pos.mul D) 1%positive.

(** The polynomial is m, its degree n; each step multiplies by its denominator. *)
Fixpoint horner (m : zvec) (n : nat) (gs : list (list Z)) : list Z :=
  match gs with
  | [] => []
  | g :: gs =>
      let r := horner m n gs in
      let top := nth (n - 1) r 0%Z in
      let more := Zpos (after (snd m) (S (length gs))) in
      table n (fun i => Zpos (snd m) * (if Nat.eqb i 0 then 0 else nth (i - 1) r 0)
                        - top * nth i (fst m) 0 + more * nth i g 0)%Z
  end.

Lemma horner_is m n (q : list Q) gs i : (forall j, val m j == nth j q 0) -> n = length q ->
  (i < n)%nat -> nth i (horner m n gs) 0%Z # after (snd m) (length gs) ==
  sum (seq 0 (length gs)) (fun a => sum (seq 0 n) (fun c =>
    nth i (power q (a + c)) 0 * inject_Z (nth c (nth a gs []) 0%Z))).
Proof.
  intros E -> . revert i. induction gs as [|g gs IH]; intros i Hi.
  - destruct i; reflexivity.
  - cbn [length seq]. rewrite <- seq_shift.
    change (0%nat :: map S (seq 0 (length gs))) with ([0%nat] ++ map S (seq 0 (length gs))).
    rewrite sum_app, sum_one, sum_map. cbn [nth Nat.add].
    rewrite (sum_ext (seq 0 (length q)) _ (fun c => (if Nat.eqb c i then 1 else 0)
      * inject_Z (nth c g 0%Z))).
    2:{ intros c Hc. apply in_seq in Hc. rewrite power_small, Nat.eqb_sym by lia. reflexivity. }
    rewrite sum_at by exact Hi.
    set (W := fun i => sum (seq 0 (length gs)) (fun a => sum (seq 0 (length q)) (fun c =>
      nth i (power q (a + c)) 0 * inject_Z (nth c (nth a gs []) 0%Z)))).
    change (forall i, (i < length q)%nat ->
      nth i (horner m (length q) gs) 0%Z # after (snd m) (length gs) == W i) in IH.
    transitivity (inject_Z (nth i g 0%Z)
      + ((if Nat.eqb i 0 then 0 else W (i - 1)%nat) + - nth i q 0 * W (length q - 1)%nat)).
    + cbn [horner]. rewrite nth_table by exact Hi.
      rewrite <- (IH (length q - 1)%nat) by lia. rewrite <- (E i). unfold val.
      change (after (snd m) (S (length gs))) with (snd m * after (snd m) (length gs))%positive.
      assert (S : (if Nat.eqb i 0 then 0 else W (i - 1)%nat) ==
        (if Nat.eqb i 0 then 0 else nth (i - 1) (horner m (length q) gs) 0)%Z
          # after (snd m) (length gs)).
      { destruct (Nat.eqb i 0); [reflexivity|]. symmetry. apply IH. lia. }
      rewrite S. unfold Qeq, Qplus, Qmult, Qopp, inject_Z; cbn [Qnum Qden].
      rewrite !Pos2Z.inj_mul. ring.
    + apply Qplus_comp; [reflexivity|]. unfold W.
      rewrite <- (sum_shifted (seq 0 (length gs)) i). apply sum_ext. intros a _.
      rewrite <- (sum_shifted (seq 0 (length q)) i). apply sum_ext. intros c _. cbn [Nat.add].
      rewrite power_S by exact Hi. destruct (Nat.eqb i 0); ring.
Qed.

(** ** The products and the blocks of a method *)

Section Maps.
Variable M : method.
Let d := degree M.
Let F := over (field M).

Definition zeros (x : list Z) : bool := forallb (Z.eqb 0) x.
Lemma zeros_are x i : zeros x = true -> nth i x 0%Z = 0%Z.
Proof.
  unfold zeros. rewrite forallb_forall. intros H.
  destruct (nth_in_or_default i x 0%Z) as [I|E]; [|exact E]. symmetry. apply Z.eqb_eq, H, I.
Qed.

(** A product of numbers. *)
Definition ztimes (F : zvec) (x y : list Z) : list Z :=
  if zeros x || zeros y then [] else horner F d (map (fun q => map (Z.mul q) y) x).

Lemma ztimes_is x y D E e : length x = d -> (e < d)%nat ->
  nth e (ztimes F x y) 0%Z # (after (snd F) d * D * E) ==
  times M (val (x, D)) (val (y, E)) e.
Proof.
  intros L He. unfold ztimes. destruct (zeros x || zeros y) eqn:Z.
  - transitivity 0; [destruct e; reflexivity|symmetry]. apply times_zero. apply orb_prop in Z.
    destruct Z as [Z|Z]; [left|right]; intros u _; unfold val; cbn [fst snd];
      rewrite zeros_are by exact Z; reflexivity.
  - set (gs := map _ x).
    pose proof (horner_is F d (field M) gs e (over_is (field M)) eq_refl He) as H.
    replace (length gs) with d in H by (unfold gs; rewrite map_length; symmetry; exact L).
    transitivity ((1 # D * E) * (nth e (horner F d gs) 0%Z # after (snd F) d)).
    { unfold Qeq, Qmult; cbn [Qnum Qden]. rewrite !Pos2Z.inj_mul. ring. }
    rewrite H, <- sum_times, times_is. apply sum_ext. intros u Hu. rewrite <- sum_times.
    apply sum_ext. intros v _.
    assert (A : nth v (nth u gs []) 0%Z = (nth u x 0 * nth v y 0)%Z).
    { unfold gs. rewrite nth_indep with (d' := map (Z.mul 0) y)
        by (rewrite map_length, L; apply in_seq in Hu; lia).
      rewrite (map_nth (fun q => map (Z.mul q) y)), <- (map_nth (Z.mul (nth u x 0%Z))).
      rewrite Z.mul_0_r. reflexivity. }
    rewrite A. unfold in_field, val, Qeq, Qmult, inject_Z; cbn [fst snd Qnum Qden].
    rewrite !Pos2Z.inj_mul. ring.
Qed.

(** The product of two numbers, of which the first has d coefficients. *)
Definition ztimes_of (x y : zvec) : zvec :=
  (ztimes F (table d (fun e => nth e (fst x) 0%Z)) (fst y), after (snd F) d * snd x * snd y)%positive.
Lemma ztimes_of_val x y e : (e < d)%nat -> val (ztimes_of x y) e == times M (val x) (val y) e.
Proof.
  intros He. transitivity (times M (val (table d (fun e => nth e (fst x) 0%Z), snd x)) (val y) e).
  - apply ztimes_is; [apply table_length|exact He].
  - apply times_ext; [|reflexivity]. intros u Hu. unfold val. cbn [fst snd].
    rewrite nth_table by exact Hu. reflexivity.
Qed.

(** Entry i of a stage value; stage values of given entries. *)
Definition part (i : nat) (x : list Z) : list Z := table d (fun e => nth (i * d + e) x 0%Z).
Definition spread (n : nat) (f : nat -> list Z) : list Z :=
  flat_map (fun i => let r := f i in table d (fun e => nth e r 0%Z)) (seq 0 n).

Lemma part_is x i e : (e < d)%nat -> val (part i (fst x), snd x) e = number_at M (val x) i e.
Proof. intros H. unfold val, part. cbn [fst snd]. rewrite nth_table by exact H. reflexivity. Qed.
Lemma nth_spread n f i e : (i < n)%nat -> (e < d)%nat ->
  nth (entry M (i, e)) (spread n f) 0%Z = nth e (f i) 0%Z.
Proof.
  intros Hi He. unfold spread, entry. fold d. cbn [fst snd].
  rewrite (nth_flat _ d _ i e 0%nat 0%Z).
  - rewrite seq_nth by exact Hi. cbv zeta. rewrite nth_table by exact He. reflexivity.
  - intros. apply table_length.
  - exact He.
  - left. rewrite seq_length. exact Hi.
Qed.
Lemma spread_length n f : length (spread n f) = (n * d)%nat.
Proof.
  unfold spread. rewrite <- (seq_length n 0) at 2. induction (seq 0 n) as [|i is IH]; [reflexivity|].
  cbn [flat_map length Nat.mul]. rewrite app_length, table_length, IH. reflexivity.
Qed.
Lemma spread_val n f D v : (forall i, (n * d <= i)%nat -> v i == 0) ->
  (forall i e, (i < n)%nat -> (e < d)%nat -> nth e (f i) 0%Z # D == v (entry M (i, e))) ->
  veq (val (spread n f, D)) v.
Proof.
  intros Beyond At k. destruct (lt_dec k (n * d)) as [L|L].
  - destruct (entry_of M k n L) as [i [e [Hi [He ->]]]]. unfold val. cbn [fst snd].
    rewrite nth_spread by assumption. apply At; assumption.
  - unfold val. cbn [fst snd]. rewrite nth_overflow by (rewrite spread_length; lia).
    rewrite Beyond by lia. reflexivity.
Qed.

(** ⊙ in a space. *)
Definition zmul (s : space) : zvec -> zvec -> zvec :=
  let F := over (field M) in
  let D := after (snd F) d in
  match s with
  | Points n => fun x y =>
      (spread n (fun i => ztimes F (part i (fst x)) (part i (fst y))), D * snd x * snd y)%positive
  | Modulo m =>
      let n := length m in
      let m := over m in
      let Dm := after (snd m) n in
      fun x y =>
        let ys := table n (fun c => part c (fst y)) in
        let ps := table n (fun a => let xa := part a (fst x) in map (ztimes F xa) ys) in
        let rs := table d (fun e => horner m n (map (map (fun p => nth e p 0%Z)) ps)) in
        (spread n (fun i => map (fun r => nth i r 0%Z) rs), Dm * (D * snd x * snd y))%positive
  end.

Lemma zmul_val l x y :
  veq (val (zmul (space_at M l) x y)) (mul (Pof M l) (val x) (val y)).
Proof.
  unfold zmul. cbv zeta. fold F. destruct (space_at M l) as [n|m] eqn:Sp;
    apply spread_val; [|intros i e Hi He|intros i Hi|intros i e Hi He].
  - intros i Hi. apply mu_beyond. unfold dim. rewrite Sp. exact Hi.
  - rewrite (mu_at_points M l n) by assumption.
    rewrite ztimes_is by (try apply table_length; exact He).
    apply (times_ext M); intros u Hu; rewrite part_is by exact Hu; reflexivity.
  - apply mu_beyond. unfold dim. rewrite Sp. exact Hi.
  - rewrite mu_is by (rewrite ?Sp; assumption). rewrite Sp. cbn [size_of].
    set (n := length m) in *.
    rewrite (nth_indep _ 0%Z (nth i [] 0%Z)) by (rewrite map_length, table_length; exact He).
    rewrite (map_nth (fun r => nth i r 0%Z)), nth_table by exact He.
    set (gs := map _ _).
    pose proof (horner_is (over m) n m gs i (over_is m) eq_refl Hi) as H.
    assert (Len : length gs = n) by (unfold gs; rewrite map_length; apply table_length).
    rewrite Len in H.
    transitivity ((1 # after (snd F) d * snd x * snd y)
      * (nth i (horner (over m) n gs) 0%Z # after (snd (over m)) n)).
    { unfold Qeq, Qmult; cbn [Qnum Qden]. rewrite !Pos2Z.inj_mul. ring. }
    rewrite H, <- sum_times. apply sum_ext. intros a Ha. rewrite <- sum_times. apply sum_ext.
    intros c Hc. apply in_seq in Ha, Hc. cbn [in_space].
    assert (A : nth c (nth a gs []) 0%Z =
      nth e (ztimes F (part a (fst x)) (part c (fst y))) 0%Z).
    { unfold gs. rewrite nth_indep with (d' := map (fun p => nth e p 0%Z) [])
        by (rewrite map_length, table_length; lia).
      rewrite (map_nth (map (fun p => nth e p 0%Z))), nth_table by lia.
      rewrite map_map.
      rewrite nth_indep with (d' := (fun y => nth e (ztimes F (part a (fst x)) y) 0%Z) [])
        by (rewrite map_length, table_length; lia).
      rewrite (map_nth (fun y => nth e (ztimes F (part a (fst x)) y) 0%Z)), nth_table by lia.
      reflexivity. }
    rewrite A.
    assert (T : times M (number_at M (val x) a) (number_at M (val y) c) e ==
      nth e (ztimes F (part a (fst x)) (part c (fst y))) 0%Z # after (snd F) d * snd x * snd y).
    { rewrite ztimes_is by (try apply table_length; exact He).
      apply (times_ext M); intros u Hu; rewrite part_is by exact Hu; reflexivity. }
    rewrite T. unfold Qeq, Qmult, inject_Z; cbn [Qnum Qden]. rewrite !Pos2Z.inj_mul. ring.
Qed.

(** A block, as a map. *)
Definition row_times (F : zvec) (row : list (list Z)) (x : list Z) : list Z :=
  fold_right (fun j r => zadd (ztimes F (nth j row []) (part j x)) r) [] (seq 0 (length row)).
Definition zapp (A : list (list number)) : zvec -> zvec :=
  let F := over (field M) in
  let D := common (concat (concat A)) in
  let DF := (after (snd F) d * D)%positive in
  let rows := map (map (fun a => table d (fun w => whole D (nth w a 0)))) A in
  fun x => (spread (length rows) (fun i => row_times F (nth i rows []) (fst x)), DF * snd x)%positive.

Lemma rows_length A : length (rows_of M A) = (length A * d)%nat.
Proof.
  unfold rows_of. induction A as [|r A IH]; [reflexivity|].
  cbn [flat_map length Nat.mul]. rewrite app_length, map_length, seq_length, IH. reflexivity.
Qed.
Lemma zapp_val A x : veq (val (zapp A x)) (app (fun i => nth i (rows_of M A) []) (val x)).
Proof.
  unfold zapp. cbv zeta. fold F. rewrite map_length. apply spread_val.
  - intros i Hi. unfold app. rewrite nth_overflow; [reflexivity|].
    rewrite rows_length. exact Hi.
  - intros i e Hi He. unfold app. rewrite row_of_block, row_is by exact He.
    set (D := common (concat (concat A))).
    set (w := fun a : number => table d (fun w => whole D (nth w a 0))).
    change [] with (map w []) at 1. rewrite (map_nth (map w)).
    assert (Row : incl (nth i A []) (concat A)).
    { destruct (nth_in_or_default i A []) as [I|E]; [|rewrite E; intros a []].
      intros a Ha. apply in_concat. exists (nth i A []). split; assumption. }
    set (row := nth i A []) in *. unfold row_times. rewrite map_length.
    assert (G : forall js, (forall j, In j js -> (j < length row)%nat) ->
      nth e (fold_right (fun j r => zadd (ztimes F (nth j (map w row) []) (part j (fst x))) r) []
        js) 0%Z # after (snd F) d * D * snd x ==
      sum js (fun j => times M (fun w => nth w (nth j row []) 0) (number_at M (val x) j) e)).
    { induction js as [|j js IH]; intros J; [destruct e; reflexivity|].
      cbn [fold_right]. rewrite nth_zadd, <- same_denominator, IH by (intros; apply J; right;
        assumption).
      unfold sum. cbn [map fold_right]. apply Qplus_comp; [|reflexivity].
      specialize (J j (or_introl eq_refl)).
      rewrite nth_indep with (d' := w []) by (rewrite map_length; exact J). rewrite map_nth.
      rewrite ztimes_is by (try apply table_length; exact He).
      apply (times_ext M); intros u Hu; [|rewrite part_is by exact Hu; reflexivity].
      unfold val, w. cbn [fst snd]. rewrite nth_table by exact Hu. symmetry.
      apply whole_is, common_divides.
      destruct (nth_in_or_default u (nth j row []) 0) as [I|E]; [left|right; exact E].
      apply in_concat. exists (nth j row []). split; [|exact I]. apply Row, nth_In, J. }
    apply G. intros j Hj. apply in_seq in Hj. lia.
Qed.
End Maps.

Definition zscale (n : nat) (x : zvec) : zvec :=
  (map (Z.mul (Z.of_nat n)) (fst x), snd x).
Lemma zscale_val n x : veq (val (zscale n x)) (scale (inject_Z (Z.of_nat n)) (val x)).
Proof.
  intros i. unfold val, scale, zscale. simpl fst. simpl snd.
  replace (nth i (map (Z.mul (Z.of_nat n)) (fst x)) 0%Z) with (Z.of_nat n * nth i (fst x) 0)%Z.
  - unfold Qeq; simpl. reflexivity.
  - rewrite <- map_nth with (f := Z.mul (Z.of_nat n)). rewrite Z.mul_0_r. reflexivity.
Qed.

(** ** Affine hulls

    A point, base/den, and directions (p, k, r): v takes the direction r k v_p / den times. *)

Record zhull := { den : positive; base : list Z; dirs : list (nat * Z * list Z) }.

Fixpoint zlin (ts : list (nat * Z)) (x : list Z) : Z :=
  match ts with [] => 0%Z | (j, q) :: r => (q * nth j x 0 + zlin r x)%Z end.

(** What the directions add to entry i. *)
Fixpoint terms (i : nat) (ds : list (nat * Z * list Z)) : list (nat * Z) :=
  match ds with
  | [] => []
  | (p, k, r) :: ds => let q := nth i r 0%Z in
      if (q =? 0)%Z then terms i ds else (p, (k * q)%Z) :: terms i ds
  end.
Definition column := (nat * Z * list (nat * Z))%type.
Definition column_at (H : zhull) (i : nat) : column :=
  (i, nth i (base H) 0%Z, terms i (dirs H)).
Definition is_equal (D t : Z) (v : zvec) (c : column) : bool :=
  let '(i, b, ts) := c in
  (nth i (fst v) 0 * D =? t * b * Zpos (snd v) + zlin ts (fst v))%Z.
(** Where an entry is its own coefficient there is nothing to see. *)
Definition is_trivial (D : Z) (c : column) : bool :=
  match c with
  | (i, b, [(p, q)]) => (b =? 0)%Z && Nat.eqb p i && (q =? D)%Z
  | _ => false
  end.
Definition width (H : zhull) : nat :=
  fold_right Nat.max (length (base H)) (map (fun d => length (snd d)) (dirs H)).

(** The point and the directions with their weights; the test for v with the weight t. *)
Definition tested := (list (zvec * Z) * (Z -> zvec -> bool))%type.
Definition prepare (H : option zhull) : tested :=
  match H with
  | None => ([], fun _ _ => false)
  | Some H =>
      (((base H, den H), 1%Z) :: map (fun d => ((snd d, 1%positive), 0%Z)) (dirs H),
       let n := width H in
       let D := Zpos (den H) in
       let columns := filter (fun c => negb (is_trivial D c)) (map (column_at H) (seq 0 n)) in
       fun t v => Nat.leb (length (fst v)) n && forallb (is_equal D t v) columns)
  end.
Definition generators (T : tested) : list (V * Q) :=
  map (fun g => (val (fst g), inject_Z (snd g))) (fst T).

Lemma max_le n : forall ns m, (fold_right Nat.max m ns <= n)%nat ->
  (m <= n)%nat /\ forall k, In k ns -> (k <= n)%nat.
Proof.
  induction ns as [|a ns IH]; simpl; intros m H; [split; [assumption|contradiction]|].
  destruct (IH m ltac:(lia)) as [I J]. split; [assumption|].
  intros k [->|K]; [lia|apply J, K].
Qed.

Lemma equal_everywhere H t v : snd (prepare (Some H)) t v = true -> forall i,
  (nth i (fst v) 0 * Zpos (den H) =
    t * nth i (base H) 0 * Zpos (snd v) + zlin (terms i (dirs H)) (fst v))%Z.
Proof.
  cbn [prepare snd]. cbv zeta. intros K i. apply andb_prop in K. destruct K as [Len K].
  apply Nat.leb_le in Len. destruct (lt_dec i (width H)) as [L|L].
  - set (D := Zpos (den H)) in *.
    destruct (is_trivial D (column_at H i)) eqn:T.
    + unfold is_trivial, column_at in T.
      destruct (terms i (dirs H)) as [|[p q] [|]]; try discriminate.
      rewrite !andb_true_iff, !Z.eqb_eq, Nat.eqb_eq in T. destruct T as [[Eb ->] ->].
      cbn [zlin]. rewrite Eb. ring.
    + rewrite forallb_forall in K. apply Z.eqb_eq, (K (column_at H i)). apply filter_In.
      split; [apply in_map, in_seq; lia|]. rewrite T. reflexivity.
  - apply Nat.nlt_ge in L. unfold width in L. destruct (max_le _ _ _ L) as [Lb J].
    rewrite (nth_overflow (fst v)) by (unfold width in Len; lia).
    rewrite (nth_overflow (base H)) by exact Lb.
    assert (E : terms i (dirs H) = []).
    { clear - J. induction (dirs H) as [|[[p k] r] ds IH]; [reflexivity|]. cbn [terms].
      rewrite nth_overflow by (apply J; left; reflexivity). apply IH. intros n Hn. apply J. right.
      exact Hn. }
    rewrite E. simpl zlin. ring.
Qed.

Fixpoint comb (D : positive) (v : V) (ds : list (nat * Z * list Z)) : V :=
  match ds with
  | [] => fun _ => 0
  | (p, k, r) :: ds => add (scale (v p * (k # D)) (val (r, 1%positive))) (comb D v ds)
  end.
Lemma comb_val D v ds i : comb D (val v) ds i == zlin (terms i ds) (fst v) # (snd v * D).
Proof.
  induction ds as [|[[p k] r] ds IH]; [reflexivity|]. cbn [comb terms].
  unfold add, scale. rewrite IH. unfold val at 2. cbn [fst snd].
  destruct (Z.eqb_spec (nth i r 0%Z) 0) as [->|_]; [ring|].
  cbn [zlin]. rewrite <- same_denominator. apply Qplus_comp; [|reflexivity].
  unfold val, Qeq, Qmult; cbn [Qnum Qden]. rewrite !Pos2Z.inj_mul. ring.
Qed.
Lemma comb_zero f D v ds : linear f ->
  (forall d, In d ds -> f (val (snd d, 1%positive)) == 0) -> f (comb D v ds) == 0.
Proof.
  intros L. induction ds as [|[[p k] r] ds IH]; cbn [comb]; intros K.
  - rewrite (l_ext _ L _ (scale 0 (fun _ => 0))); [rewrite (l_scale _ L); ring|].
    intros i. unfold scale. ring.
  - rewrite (l_add _ L), (l_scale _ L), (K _ (or_introl eq_refl)), IH; [ring|].
    intros; apply K; right; assumption.
Qed.

Lemma tested_is_in H t v : snd (prepare H) t v = true ->
  hull (generators (prepare H)) (inject_Z t) (val v).
Proof.
  destruct H as [H|]; [|discriminate]. intros K f c L G.
  pose proof (equal_everywhere H t v K) as I.
  assert (B : f (val (base H, den H)) == c).
  { rewrite <- (Qmult_1_l c). apply (G (val (base H, den H), inject_Z 1)). left. reflexivity. }
  assert (D : forall d, In d (dirs H) -> f (val (snd d, 1%positive)) == 0).
  { intros d Hd. rewrite <- (Qmult_0_l c). apply (G (val (snd d, 1%positive), inject_Z 0)).
    right. rewrite map_map. apply in_map_iff. exists d. split; [reflexivity|exact Hd]. }
  rewrite (l_ext _ L _ (add (scale (inject_Z t) (val (base H, den H)))
    (comb (den H) (val v) (dirs H)))).
  - rewrite (l_add _ L), (l_scale _ L), B, (comb_zero f _ _ _ L D). ring.
  - intros i. unfold add, scale. rewrite comb_val. unfold val; cbn [fst snd]. specialize (I i).
    unfold Qeq, Qplus, Qmult, inject_Z; cbn [Qnum Qden].
    rewrite !Pos2Z.inj_mul in *.
    transitivity ((nth i (fst v) 0 * Zpos (den H)) * Zpos (den H) * Zpos (snd v))%Z; [ring|].
    rewrite I. ring.
Qed.

Lemma hull_ext S t v w : veq v w -> hull S t v -> hull S t w.
Proof. intros E H f c L K. rewrite <- (l_ext _ L v w E). apply H; assumption. Qed.

(** ** The checker *)

Section Checker.
Variable M : method.
Variable p : nat.
Variable F G : list (list (option zhull)).
(* F by k = 0, …, p − 1, G by the order of a branch, both by the colour; None where no tree is *)

Definition is_seen l m := match block M (space_of M l) m with None => false | _ => true end.
Definition the_block l m := match block M (space_of M l) m with None => [] | Some A => A end.
Definition zone l : zvec := (map Qnum (one_of M (space_at M l)), 1%positive).

(** Products, blocks and weights as maps, made once. *)
Record zmaps := {
  zP : list (zvec -> zvec -> zvec); zA : list (list (zvec -> zvec)); zW : list (zvec -> zvec) }.
Definition the_maps : zmaps := {|
  zP := table (N M) (fun l => zmul M (space_at M l));
  zA := table (N M) (fun l => table (N M) (fun m => zapp M (the_block l m)));
  zW := table (N M) (fun l => zapp M [snd (nth l (colours M) (O, []))]) |}.

Section WithMaps.
Variable T : zmaps.
Definition Pz l := nth l (zP T) (fun x _ => x).
Definition Az l m := nth m (nth l (zA T) []) (fun x => x).
Definition Wz l := nth l (zW T) (fun x => x).

(** b_l(v) = 1/(k + 1), or 0 for a direction. *)
Definition meets l k (t : Z) (v : zvec) : bool :=
  let x := Wz l v in
  all (degree M) (fun e => Qeq_bool (val x e)
    (inject_Z t * if Nat.eqb e 0 then 1 # Pos.of_nat (S k) else 0)).

Section WithHulls.
Variables Fs Gs : list (list tested).
Definition Fof k l := nth l (nth k Fs []) (prepare None).
Definition Gof j l := nth l (nth j Gs []) (prepare None).

Definition starts_ok := all (N M) (fun l => snd (Fof 0 l) 1%Z (zone l)).

Definition branches_ok :=
  all (p - 1) (fun j => all (N M) (fun l => all (N M) (fun m =>
    negb (is_seen l m) ||
    forallb (fun a => snd (Gof (S j) l) (snd a) (Az l m (zscale (S j) (fst a))))
      (fst (Fof j m))))).

Definition products_ok :=
  all p (fun k => all (N M) (fun l => all k (fun i =>
    forallb (fun u => forallb (fun w => snd (Fof k l) (snd u * snd w)%Z (Pz l (fst u) (fst w)))
      (fst (Fof (k - S i) l))) (fst (Gof (S i) l))))).

Definition conditions_ok :=
  all p (fun k => all (N M) (fun l => forallb (fun a => meets l k (snd a) (fst a))
    (fst (Fof k l)))).
End WithHulls.

Lemma seen_iff l m : sees M l m <-> is_seen l m = true.
Proof. unfold sees, is_seen. destruct (block M (space_of M l) m); split; congruence. Qed.

Hypothesis made : T = the_maps.

Lemma zone_val l : veq (val (zone l)) (oneof M l).
Proof.
  intros i. unfold val, zone, oneof; simpl. fold (space_at M l). set (os := one_of M _).
  replace (nth i (map Qnum os) 0%Z) with (Qnum (nth i os 0)) by (symmetry; apply (map_nth Qnum os
    0)).
  destruct (nth_in_or_default i os 0) as [K|K]; [|rewrite K; reflexivity].
  revert K. generalize (nth i os 0) as q. intros q K. unfold os, one_of in K.
  apply in_map_iff in K. destruct K as [[j e] [<- _]].
  destruct (space_at M l); [destruct (Nat.eqb e 0)|destruct (Nat.eqb (j + e) 0)]; reflexivity.
Qed.

Lemma P_val l x y : (l < N M)%nat ->
  veq (val (Pz l x y)) (mul (Pof M l) (val x) (val y)).
Proof.
  intros H. unfold Pz. rewrite made. simpl. rewrite nth_table by exact H. apply zmul_val.
Qed.

Lemma A_val l m x : (l < N M)%nat -> (m < N M)%nat ->
  veq (val (Az l m x)) (app (Aof M l m) (val x)).
Proof.
  intros H K. unfold Az. rewrite made. simpl. rewrite !nth_table by assumption.
  intros i. rewrite (zapp_val M _ x i). unfold Aof, rows, the_block.
  destruct (block M (space_of M l) m); reflexivity.
Qed.

Lemma b_val l e v : (l < N M)%nat -> (e < degree M)%nat -> b M l e (val v) == val (Wz l v) e.
Proof.
  intros Hl He. unfold Wz. rewrite made. simpl. rewrite nth_table by exact Hl.
  rewrite (zapp_val M _ v e). unfold b, app.
  change e with (entry M (0%nat, e)) at 2. rewrite row_of_block by exact He. reflexivity.
Qed.

Lemma meets_val l k t v : (l < N M)%nat -> meets l k t v = true <->
  forall e, (e < degree M)%nat ->
    b M l e (val v) == inject_Z t * if Nat.eqb e 0 then 1 # Pos.of_nat (S k) else 0.
Proof.
  intros Hl. unfold meets, all. rewrite forallb_forall. split; intros H e He.
  - rewrite b_val by assumption. apply Qeq_bool_iff, H, in_seq. lia.
  - apply in_seq in He. apply Qeq_bool_iff. rewrite <- (H e) by lia. symmetry. apply b_val; lia.
Qed.

Definition hulls (Hs : list (list (option zhull))) := map (map prepare) Hs.
Lemma test_val Hs k l t v : let H := nth l (nth k (hulls Hs) []) (prepare None) in
  snd H t v = true -> hull (generators H) (inject_Z t) (val v).
Proof.
  assert (E : nth l (nth k (hulls Hs) []) (prepare None) = prepare (nth l (nth k Hs []) None)).
  { rewrite <- (map_nth prepare). f_equal. exact (map_nth (map prepare) Hs [] k). }
  cbv zeta. rewrite E. apply tested_is_in.
Qed.

Theorem proved_order : let Fs := hulls F in let Gs := hulls G in
  starts_ok Fs = true -> branches_ok Fs Gs = true -> products_ok Fs Gs = true ->
  conditions_ok Fs = true -> has_order M p.
Proof.
  intros Fs Gs St Br Pr Co t Ho Ht.
  set (FF := fun k l => generators (Fof Fs k l)). set (GG := fun j l => generators (Gof Gs j l)).
  assert (H : hull (FF (order t - 1)%nat (root t)) 1 (psi (Pof M) (Aof M) (oneof M) t)).
  { apply (trees_are_spanned (Pof M) (Aof M) (oneof M) (sees M) (N M) p FF GG);
      [| | |assumption|assumption].
    - intros l Hl. apply hull_ext with (1 := zone_val l).
      apply (test_val F), (all_at _ _ St l Hl).
    - intros j l m Hj Hl Hm Hs a Ha. apply in_map_iff in Ha. destruct Ha as [z [<- Hz]].
      pose proof (all_at _ _ (all_at _ _ (all_at _ _ Br j ltac:(lia)) l Hl) m Hm) as K.
      cbv beta in K. rewrite (proj1 (seen_iff l m) Hs) in K. cbn [negb orb] in K.
      rewrite forallb_forall in K. specialize (K z Hz).
      apply (test_val G) in K. revert K. apply hull_ext.
      intros i. rewrite (A_val l m _ Hl Hm i). apply app_ext, zscale_val.
    - intros k l j Hk Hl Hj u w Hu Hw.
      apply in_map_iff in Hu. destruct Hu as [u' [<- Hu]].
      apply in_map_iff in Hw. destruct Hw as [w' [<- Hw]].
      pose proof (all_at _ _ (all_at _ _ (all_at _ _ Pr k Hk) l Hl) (j - 1)%nat ltac:(lia)) as K.
      cbv beta in K. replace (S (j - 1)) with j in K by lia.
      rewrite forallb_forall in K. specialize (K u' Hu). rewrite forallb_forall in K.
      specialize (K w' Hw). apply (test_val F) in K. revert K. apply hull_ext, P_val, Hl. }
  assert (Hl : (root t < N M)%nat) by (apply (colour_below (sees M) (N M)), Ht).
  pose proof (order_pos t) as Op.
  intros e He. rewrite <- (Qmult_1_l (if Nat.eqb e 0 then _ else _)).
  apply H; [apply lin_linear|]. intros s Hs.
  apply in_map_iff in Hs. destruct Hs as [z [<- Hz]].
  pose proof (all_at _ _ (all_at _ _ Co (order t - 1)%nat ltac:(lia)) (root t) Hl) as K.
  cbv beta in K. rewrite forallb_forall in K. apply meets_val with (2 := K z Hz) in He; [|exact Hl].
  replace (S (order t - 1)) with (order t) in He by lia. exact He.
Qed.

(** ** A tree that fails *)

(** A tree with ψ at each vertex, and what it contributes to the vertex below. *)
Inductive ztree := ZNode : nat -> zvec -> zvec -> list ztree -> ztree.
Definition psi_at t := match t with ZNode _ v _ _ => v end.
Definition worth_of t := match t with ZNode _ _ w _ => w end.
Fixpoint plain t : tree := match t with ZNode l _ _ us => Node l (map plain us) end.

Definition zequal (x y : zvec) : bool :=
  all (Nat.max (length (fst x)) (length (fst y))) (fun i =>
    nth i (fst x) 0 * Zpos (snd y) =? nth i (fst y) 0 * Zpos (snd x))%Z.
Fixpoint is_psi t : bool :=
  match t with ZNode l v _ us =>
    zequal v (fold_right (fun u r => Pz l (worth_of u) r) (zone l) us) &&
    forallb (fun u => is_psi u &&
      zequal (worth_of u) (Az l (root (plain u)) (zscale (order (plain u)) (psi_at u)))) us
  end.

Fixpoint is_admissible t : bool :=
  match t with Node l us =>
    Nat.ltb l (N M) &&
    (fix each us := match us with
       | [] => true | u :: r => is_seen l (root u) && is_admissible u && each r end) us
  end.

Lemma tree_ind' (P : tree -> Prop) :
  (forall l us, (forall u, In u us -> P u) -> P (Node l us)) -> forall t, P t.
Proof.
  intros H. fix IH 1. intros [l us]. apply H.
  induction us as [|u r IHr]; [contradiction|]. intros v [<-|K]; [apply IH|apply IHr, K].
Qed.

Lemma admissible_iff t : is_admissible t = true -> is_tree M t.
Proof.
  induction t as [l us IH] using tree_ind'. unfold is_tree. simpl. intros H.
  apply andb_prop in H. destruct H as [Hl H]. split; [apply Nat.ltb_lt, Hl|].
  induction us as [|u r IHr]; [exact I|].
  apply andb_prop in H. destruct H as [H Hr]. apply andb_prop in H. destruct H as [Hs Hu].
  split; [apply seen_iff, Hs|]. split; [apply IH; [left; reflexivity|exact Hu]|].
  apply IHr; [intros v K; apply IH; right; exact K|exact Hr].
Qed.

Lemma mul_ext P x x' y y' : veq x x' -> veq y y' -> veq (mul P x y) (mul P x' y').
Proof.
  intros H K i. unfold mul. rewrite (l_ext _ (bil_left (P i) y) x x' H).
  apply (l_ext _ (bil_right (P i) x')), K.
Qed.

Lemma veq_trans x y z : veq x y -> veq y z -> veq x z.
Proof. intros H K i. rewrite (H i). apply K. Qed.

Lemma zequal_val x y : zequal x y = true -> veq (val x) (val y).
Proof.
  intros H i. unfold val, Qeq. cbn [Qnum Qden].
  destruct (lt_dec i (Nat.max (length (fst x)) (length (fst y)))) as [L|L].
  - apply Z.eqb_eq, (all_at _ _ H i L).
  - rewrite !nth_overflow by lia. reflexivity.
Qed.

Lemma ztree_ind' (P : ztree -> Prop) :
  (forall l v w us, (forall u, In u us -> P u) -> P (ZNode l v w us)) -> forall t, P t.
Proof.
  intros H. fix IH 1. intros [l v w us]. apply H.
  induction us as [|u r IHr]; [contradiction|]. intros v' [<-|K]; [apply IH|apply IHr, K].
Qed.

Lemma psi_val t : is_psi t = true -> is_tree M (plain t) ->
  veq (val (psi_at t)) (psi (Pof M) (Aof M) (oneof M) (plain t)).
Proof.
  induction t as [l v w us IH] using ztree_ind'. unfold is_tree. cbn [is_psi plain psi_at].
  intros H [Hl Hus]. apply andb_prop in H. destruct H as [E H].
  apply veq_trans with (1 := zequal_val _ _ E). clear v E. rewrite forallb_forall in H.
  induction us as [|u r IHr]; [apply zone_val|]. destruct Hus as [Hs [Hu Hr]].
  pose proof (H u (or_introl eq_refl)) as Hu'. apply andb_prop in Hu'. destruct Hu' as [Pu Wu].
  cbn [fold_right map]. eapply veq_trans; [apply P_val, Hl|]. apply mul_ext.
  - apply veq_trans with (1 := zequal_val _ _ Wu).
    eapply veq_trans; [apply A_val; [exact Hl|apply (colour_below (sees M) (N M)), Hu]|].
    apply app_ext. eapply veq_trans; [apply zscale_val|]. intros i. unfold scale.
    rewrite (IH u (or_introl eq_refl) Pu Hu i). reflexivity.
  - apply IHr; [intros x K; apply IH; right; exact K|intros x K; apply H; right; exact K|exact Hr].
Qed.

Definition fails (t : ztree) : bool :=
  is_admissible (plain t) && is_psi t &&
  negb (meets (root (plain t)) (order (plain t) - 1) 1%Z (psi_at t)).

Theorem proved_failure t : fails t = true -> is_tree M (plain t) /\ ~ holds M (plain t).
Proof.
  intros H. apply andb_prop in H. destruct H as [H Fl]. apply andb_prop in H.
  destruct H as [Ha Ps]. apply admissible_iff in Ha. split; [assumption|]. intros C.
  assert (Hl : (root (plain t) < N M)%nat) by (apply (colour_below (sees M) (N M)), Ha).
  apply negb_true_iff in Fl. pose proof (order_pos (plain t)) as Op.
  assert (K : meets (root (plain t)) (order (plain t) - 1) 1%Z (psi_at t) = true); [|congruence].
  apply meets_val; [exact Hl|]. intros e He.
  replace (S (order (plain t) - 1)) with (order (plain t)) by lia.
  rewrite Qmult_1_l, <- (C e He). apply (l_ext _ (lin_linear _)), psi_val; assumption.
Qed.
End WithMaps.
End Checker.

(** ** What is asked of a method: its order, and that it is no higher *)

Definition order_is_proved M p F G : bool :=
  let T := the_maps M in
  let Fs := hulls F in
  let Gs := hulls G in
  starts_ok M Fs && branches_ok M p T Fs Gs && products_ok M p T Fs Gs && conditions_ok M p T Fs.

Theorem has_order_by M p F G : order_is_proved M p F G = true -> has_order M p.
Proof.
  intros H. unfold order_is_proved in H. cbv zeta in H.
  repeat (apply andb_prop in H; destruct H as [H ?]).
  eapply proved_order; try eassumption. reflexivity.
Qed.

Theorem not_higher_by M p t :
  Nat.eqb (order (plain t)) (S p) && fails M (the_maps M) t = true -> ~ has_order M (S p).
Proof.
  intros H. apply andb_prop in H. destruct H as [O K].
  apply Nat.eqb_eq in O. destruct (proved_failure M _ eq_refl t K) as [Ht C].
  intros G. apply C, G; [lia|assumption].
Qed.
